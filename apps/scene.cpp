#include "apps/scene.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/json_fields.hpp"
#include "wound/input_error.hpp"

namespace app {
using nlohmann::json;

namespace {

std::filesystem::path beside(const std::filesystem::path& scene, const std::string& file)
{
    return file.empty() ? std::filesystem::path{} : scene.parent_path() / file; // an absolute `file` stays as it is
}

passes::Place read_place(Fields& fields)
{
    const json* value = fields.get("at");
    if (value == nullptr)
        return WoundScene{}.place;
    if (value->is_string())
        return value->get<std::string>();
    if (value->is_array() && value->size() == 2)
    {
        const auto at = fields.numbers<2>("at", {}, -3, 3);
        return passes::FacePoint{at[0], at[1]};
    }
    if (value->is_array() && value->size() == 3)
    {
        const auto at = fields.numbers<3>("at", {}, -10, 10);
        return glm::dvec3(at[0], at[1], at[2]);
    }
    fields.fail("at", "is " + value->dump(), "give a named place, face coordinates [x, y] or a point [x, y, z] in metres");
}

Direction read_direction(Fields& fields, const Direction& fallback)
{
    return {fields.number("azimuth_deg", fallback.azimuth_deg, -180, 180),
            fields.number("elevation_deg", fallback.elevation_deg, -89, 89)};
}

wound::Healing read_healing(const json& object, const std::string& where)
{
    Fields fields(object, where);
    wound::Healing healing;
    const std::string model = fields.choice("model", healing.model == wound::HealingModel::face ? "face" : "contraction", {"contraction", "face"});
    healing.model = model == "face" ? wound::HealingModel::face : wound::HealingModel::contraction;
    healing.curve.gamma = fields.number("gamma", healing.curve.gamma, 0.5, 4);
    healing.curve.delta = fields.number("delta", healing.curve.delta, 0, 10);
    healing.curve.theta = fields.number("theta", healing.curve.theta, -1, 1);
    healing.residual_border = fields.number("residual_border", healing.residual_border, 0, 1);
    fields.finish();
    return healing;
}

WoundScene read_wound(const json& object, const std::string& where, const std::filesystem::path& scene)
{
    Fields fields(object, where);
    WoundScene wound;
    wound.photo = beside(scene, fields.text("photo", ""));
    wound.mask = beside(scene, fields.text("mask", ""));
    wound.kind = fields.choice("kind", wound.kind, {"abrasion", "laceration", "avulsion"});
    wound.seed = std::uint32_t(fields.integer("seed", wound.seed, 0, 0xffffffff));
    wound.place = read_place(fields);
    wound.width_mm = fields.number("width_mm", wound.width_mm, 1, 200);
    wound.roll_deg = fields.number("roll_deg", wound.roll_deg, -360, 360);
    wound.depth_factor = fields.number("depth_factor", wound.depth_factor, 0, 5);
    if (const json* healing = fields.get("healing"))
        wound.healing = read_healing(*healing, fields.where("healing"));
    if (!wound.mask.empty() && wound.photo.empty())
        fields.fail("mask", "is given without a photo", "name the photo it belongs to");
    fields.finish();
    return wound;
}

LightScene read_light(const json& object, const std::string& where)
{
    Fields fields(object, where);
    LightScene light;
    light.from = read_direction(fields, light.from);
    light.directional = fields.boolean("directional", light.directional);
    light.distance_m = fields.number("distance_m", light.distance_m, 0, 100);
    light.color = fields.numbers<3>("color", light.color, 0, 1000);
    light.intensity = fields.number("intensity", light.intensity, 0, 1e6);
    fields.finish();
    return light;
}

CameraScene read_camera(const json& object, const std::string& where)
{
    Fields fields(object, where);
    CameraScene camera;
    camera.from = read_direction(fields, camera.from);
    camera.distance_m = fields.number("distance_m", camera.distance_m, 0, 100);
    camera.fov_deg = fields.number("fov_deg", camera.fov_deg, 1, 120);
    fields.finish();
    return camera;
}

std::vector<double> read_days(const json& value, const std::string& where)
{
    if (value.is_string())
        return parse_days(value.get<std::string>(), where);
    if (!value.is_array() || value.empty())
        throw cicatrix::InputError(where, "is " + value.dump(), "write \"0:30:3\" or an array of days");
    std::string text;
    for (const json& day : value)
        text += (text.empty() ? "" : ",") + day.dump();
    return parse_days(text, where);
}

} // namespace

Scene read_scene(const std::filesystem::path& path)
{
    const json root = read_json(path);
    const std::string file = path.string() + ": ";
    Fields fields(root, file);
    Scene scene;
    scene.head = beside(path, fields.text("head", ""));
    if (const json* wounds = fields.get("wounds"))
    {
        if (!wounds->is_array() || wounds->size() > std::size_t(shared::MAX_WOUNDS))
            fields.fail("wounds", "is " + wounds->dump().substr(0, 60), fmt::format("give an array of at most {} wounds", shared::MAX_WOUNDS));
        scene.wounds.clear();
        for (std::size_t i = 0; i < wounds->size(); ++i)
            scene.wounds.push_back(read_wound((*wounds)[i], fmt::format("{}/wounds/{}", file, i), path));
    }
    scene.tissue = fields.text("tissue", scene.tissue);
    if (scene.tissue.ends_with(".json"))
        scene.tissue = beside(path, scene.tissue).string();
    scene.reflectance_model = fields.choice("reflectance_model", scene.reflectance_model, {"published", "clamped", "two-stream"});
    if (const json* shading = fields.get("shading"))
        scene.shading = read_shading(*shading, file + "/shading");
    if (const json* lights = fields.get("lights"))
    {
        if (!lights->is_array() || lights->size() > std::size_t(shared::MAX_LIGHTS))
            fields.fail("lights", "is " + lights->dump().substr(0, 60), fmt::format("give an array of at most {} lights", shared::MAX_LIGHTS));
        scene.lights.clear();
        for (std::size_t i = 0; i < lights->size(); ++i)
            scene.lights.push_back(read_light((*lights)[i], fmt::format("{}/lights/{}", file, i)));
    }
    scene.ambient = fields.number("ambient", scene.ambient, 0, 1000);
    if (const json* camera = fields.get("camera"))
        scene.camera = read_camera(*camera, file + "/camera");
    if (const json* size = fields.get("size"))
        scene.size = parse_size(size->is_string() ? size->get<std::string>() : size->dump(), file + "/size");
    scene.samples = fields.boolean("msaa", scene.samples == 4) ? 4 : 1;
    scene.exposure = fields.number("exposure", scene.exposure, 0, 1e6);
    if (const json* days = fields.get("days"))
        scene.days = read_days(*days, file + "/days");
    fields.finish();
    return scene;
}

std::vector<double> parse_days(const std::string& text, const std::string& where)
{
    const std::string cure = "write \"first:last:step\" or days separated by commas, from 0 to 3650";
    const char separator = text.find(':') != std::string::npos ? ':' : ',';
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();)
    {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        double number = 0;
        const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, number);
        if (error != std::errc{} || stop != text.data() + end || !(number >= 0 && number <= 3650))
            throw cicatrix::InputError(where, "\"" + text + "\" holds no valid day at \"" + text.substr(begin, end - begin) + "\"", cure);
        numbers.push_back(number);
        begin = end + 1;
    }
    if (separator == ',')
        return numbers;
    if (numbers.size() != 3 || numbers[1] < numbers[0] || numbers[2] <= 0 || (numbers[1] - numbers[0]) / numbers[2] > 10000)
        throw cicatrix::InputError(where, "\"" + text + "\" is no range of days", cure);
    std::vector<double> days;
    for (int i = 0; numbers[0] + i * numbers[2] <= numbers[1] + 1e-9 * numbers[2]; ++i)
        days.push_back(numbers[0] + i * numbers[2]);
    return days;
}

std::array<std::uint32_t, 2> parse_size(const std::string& text, const std::string& where)
{
    std::array<std::uint32_t, 2> size{};
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size[0]);
    const bool cross = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
    const auto height = cross ? std::from_chars(width.ptr + 1, end, size[1]) : width;
    if (!cross || height.ec != std::errc{} || height.ptr != end || std::ranges::any_of(size, [](auto s) { return s < 16 || s > 16384; }))
        throw cicatrix::InputError(where, "\"" + text + "\" is no picture size", "write WIDTHxHEIGHT, each from 16 to 16384, as in 1280x720");
    return size;
}

} // namespace app
