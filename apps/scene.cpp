#include "apps/scene.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/json_fields.hpp"
#include "apps/output.hpp"
#include "apps/scene_camera.hpp"
#include "shaders/shared/shading.h"
#include "wound/fit.hpp"
#include "wound/input_error.hpp"

namespace app {
using nlohmann::json;

namespace {

std::filesystem::path beside(const std::filesystem::path& scene, const std::string& file)
{
    return file.empty() ? std::filesystem::path{}
                        : scene.parent_path() / file; // an absolute `file` stays as it is
}

passes::Place read_place(Fields& fields)
{
    const json* value = fields.get("at");
    if (value == nullptr)
        return WoundScene{}.place;
    if (value->is_string())
        return value->get<std::string>();
    if (value->is_array() && value->size() == 2) {
        const auto at = fields.numbers<2>("at", {}, -3, 3);
        return passes::FacePoint{at[0], at[1]};
    }
    if (value->is_array() && value->size() == 3) {
        const auto at = fields.numbers<3>("at", {}, -10, 10);
        return glm::dvec3(at[0], at[1], at[2]);
    }
    fields.fail("at", "is " + value->dump(),
                "give a named place, face coordinates [x, y] or a point [x, y, z] in metres");
}

wound::Healing read_healing(const json& object, const std::string& where, const std::filesystem::path& scene,
                            wound::Healing healing)
{
    Fields fields(object, where);
    const std::string model =
        fields.choice("model", healing.model == wound::HealingModel::face ? "face" : "contraction",
                      {"contraction", "face"});
    healing.model = model == "face" ? wound::HealingModel::face : wound::HealingModel::contraction;
    const std::string series = fields.text("series", "");
    if (const std::string areas = fields.text("areas", ""); !areas.empty())
        healing.curve = wound::curve_from_areas(beside(scene, areas), series);
    else if (!series.empty())
        fields.fail("series", "names a series of no table", "give areas, a CSV of measured areas");
    healing.curve.gamma = fields.number("gamma", healing.curve.gamma, 0.5, 4);
    healing.curve.delta = fields.number("delta", healing.curve.delta, 0, 10);
    healing.curve.theta = fields.number("theta", healing.curve.theta, -1, 1);
    healing.residual_border = fields.number("residual_border", healing.residual_border, 0, 1);
    fields.finish();
    return healing;
}

json hints_to_json(const wound::SegmentationHints& hints)
{
    json object = json::object();
    if (hints.rect)
        object["rect"] = {hints.rect->x, hints.rect->y, hints.rect->width, hints.rect->height};
    if (hints.seed)
        object["seed"] = {hints.seed->x, hints.seed->y};
    return object;
}

WoundScene read_wound(const json& object, const std::string& where, const std::filesystem::path& scene,
                      const wound::Healing& healing_of_all)
{
    Fields fields(object, where);
    WoundScene wound;
    wound.healing = healing_of_all;
    wound.photo = beside(scene, fields.text("photo", ""));
    wound.mask = beside(scene, fields.text("mask", ""));
    wound.kind = fields.choice("kind", wound.kind, {"abrasion", "laceration", "avulsion"});
    wound.seed = std::uint32_t(fields.integer("seed", wound.seed, 0, 0xffffffff));
    wound.place = read_place(fields);
    wound.width_mm = fields.number("width_mm", wound.width_mm, 1, 200);
    wound.roll_deg = fields.number("roll_deg", wound.roll_deg, -360, 360);
    wound.depth_factor = fields.number("depth_factor", wound.depth_factor, 0, 5);
    if (const json* healing = fields.get("healing"))
        wound.healing = read_healing(*healing, fields.where("healing"), scene, wound.healing);
    if (const json* hints = fields.get("segmentation"))
        wound.segmentation = read_hints(*hints, fields.where("segmentation"));
    if (!wound.mask.empty() && wound.photo.empty())
        fields.fail("mask", "is given without a photo", "name the photo it belongs to");
    if (wound.segmentation.any() && wound.photo.empty())
        fields.fail("segmentation", "is given without a photo", "name the photo in which to look");
    if (wound.segmentation.any() && !wound.mask.empty())
        fields.fail("segmentation", "is given beside a mask", "give one of the two: a mask needs no hints");
    fields.finish();
    return wound;
}

LightScene read_light(const json& object, const std::string& where)
{
    Fields fields(object, where);
    LightScene light;
    light.from = read_direction(fields, light.from);
    light.directional = fields.boolean("directional", light.directional);
    light.falloff = fields.boolean("falloff", light.falloff);
    light.distance_m = fields.number("distance_m", light.distance_m, 0, 100);
    light.color = fields.numbers<3>("color", light.color, 0, 1000);
    light.intensity = fields.number("intensity", light.intensity, 0, 1e4);
    if (const double brightest = light.intensity * *std::ranges::max_element(light.color); brightest > 1e4)
        fields.fail("intensity", fmt::format("times the color is {}", cicatrix::plain(brightest)),
                    "keep that at most 1e4");
    fields.finish();
    return light;
}

wound::Rung read_rung(Fields& fields, wound::Rung fallback)
{
    std::vector<std::string> names;
    for (const wound::Rung rung : wound::all_rungs())
        names.emplace_back(name(rung));
    return wound::rung_named(fields.choice("reflectance_model", std::string(name(fallback)), names));
}

/// An enum by the names of its values, in order.
template <typename Enum>
Enum read_enum(Fields& fields, const std::string& name, Enum fallback, const std::vector<std::string>& names)
{
    const std::string chosen = fields.choice(name, names[std::size_t(fallback)], names);
    return Enum(std::ranges::find(names, chosen) - names.begin());
}

const std::vector<std::string> ward_names{"published", "duer", "bounded"},
    translucency_names{"published", "bounded"}, blend_names{"published", "corrected"};

passes::Shading read_shading(const json& object, const std::string& where, passes::Shading shading)
{
    Fields fields(object, where);
    wound::Shading& model = shading.model;
    shading.lambert = fields.boolean("lambert", shading.lambert);
    shading.translucency = fields.boolean("translucency", shading.translucency);
    shading.ward = fields.boolean("ward", shading.ward);
    shading.normal_map = fields.boolean("normal_map", shading.normal_map);
    shading.shadow = fields.boolean("shadow", shading.shadow);
    model.ward = read_enum(fields, "ward_model", model.ward, ward_names);
    model.translucency = read_enum(fields, "translucency_model", model.translucency, translucency_names);
    shading.blend = read_enum(fields, "blend", shading.blend, blend_names);
    model.rho_d = fields.number("rho_d", model.rho_d, 0, 1);
    model.rho_ts = fields.number("rho_ts", model.rho_ts, 0, 1);
    model.rho_s = fields.number("rho_s", model.rho_s, 0, 1);
    model.alpha = fields.number("alpha", model.alpha, -1e6, 1e6);
    model.beta = fields.number("beta", model.beta, -1e6, 1e6);
    model.gamma = fields.number("gamma", model.gamma, 0, 100);
    model.alpha_x = fields.number("alpha_x", model.alpha_x, 1e-4, 1.5);
    model.alpha_y = fields.number("alpha_y", model.alpha_y, 1e-4, 1.5);
    const auto ambient =
        fields.numbers<3>("ambient", {shading.ambient.x, shading.ambient.y, shading.ambient.z}, 0, 1000);
    shading.ambient = glm::vec3(ambient[0], ambient[1], ambient[2]);
    fields.finish();
    return shading;
}

std::vector<double> read_days(const json& value, const std::string& where)
{
    if (value.is_string())
        return parse_days(value.get<std::string>(), where);
    if (value.is_number())
        return parse_days(value.dump(), where);
    if (!value.is_array() || value.empty())
        throw cicatrix::InputError(where, "is " + value.dump(), "write \"0:30:3\" or an array of days");
    std::string text;
    for (const json& day : value)
        text += (text.empty() ? "" : ",") + day.dump();
    return parse_days(text, where);
}

} // namespace

wound::SegmentationHints read_hints(const json& object, const std::string& where)
{
    constexpr double most = 1 << 20; // whether they lie in the photograph is seen when that is read
    Fields fields(object, where);
    wound::SegmentationHints hints;
    if (fields.has("rect")) {
        const auto rect = fields.numbers<4>("rect", {}, 0, most);
        hints.rect = cv::Rect(int(rect[0]), int(rect[1]), int(rect[2]), int(rect[3]));
    }
    if (fields.has("seed")) {
        const auto seed = fields.numbers<2>("seed", {}, 0, most);
        hints.seed = cv::Point(int(seed[0]), int(seed[1]));
    }
    fields.finish();
    return hints;
}

passes::Shading corrected_shading()
{
    passes::Shading shading;
    shading.model = wound::skin_shading();
    shading.ambient = glm::vec3(0.14f, 0.145f, 0.16f);
    return shading;
}

passes::Shading published_shading()
{
    passes::Shading shading;
    shading.model.ward = wound::WardModel::Published;
    shading.model.translucency = wound::TranslucencyModel::Published;
    shading.blend = wound::BlendModel::Published;
    shading.shadow = false;
    return shading;
}

json to_json(const Scene& scene)
{
    const passes::Shading& shading = scene.shading;
    const wound::Shading& model = shading.model;
    json wounds = json::array(), lights = json::array();
    for (const WoundScene& wound : scene.wounds) {
        json at;
        if (const auto* place = std::get_if<std::string>(&wound.place))
            at = *place;
        else if (const auto* face = std::get_if<passes::FacePoint>(&wound.place))
            at = {face->x, face->y};
        else
            at = {std::get<glm::dvec3>(wound.place).x, std::get<glm::dvec3>(wound.place).y,
                  std::get<glm::dvec3>(wound.place).z};
        const wound::Healing& healing = wound.healing;
        wounds.push_back({{"photo", wound.photo.string()},
                          {"mask", wound.mask.string()},
                          {"segmentation", hints_to_json(wound.segmentation)},
                          {"kind", wound.kind},
                          {"seed", wound.seed},
                          {"at", at},
                          {"width_mm", wound.width_mm},
                          {"roll_deg", wound.roll_deg},
                          {"depth_factor", wound.depth_factor},
                          {"healing",
                           {{"model", healing.model == wound::HealingModel::face ? "face" : "contraction"},
                            {"delta", healing.curve.delta},
                            {"gamma", healing.curve.gamma},
                            {"theta", healing.curve.theta},
                            {"residual_border", healing.residual_border}}}});
    }
    for (const LightScene& light : scene.lights)
        lights.push_back({{"azimuth_deg", light.from.azimuth_deg},
                          {"elevation_deg", light.from.elevation_deg},
                          {"distance_m", light.distance_m},
                          {"directional", light.directional},
                          {"falloff", light.falloff},
                          {"color", light.color},
                          {"intensity", light.intensity}});
    return {{"head", scene.head.string()},
            {"wounds", wounds},
            {"tissue", scene.tissue},
            {"reflectance_model", name(scene.reflectance_model)},
            {"shading",
             {{"lambert", shading.lambert},
              {"translucency", shading.translucency},
              {"ward", shading.ward},
              {"normal_map", shading.normal_map},
              {"shadow", shading.shadow},
              {"ward_model", ward_names[std::size_t(model.ward)]},
              {"translucency_model", translucency_names[std::size_t(model.translucency)]},
              {"blend", blend_names[std::size_t(shading.blend)]},
              {"rho_d", model.rho_d},
              {"rho_ts", model.rho_ts},
              {"rho_s", model.rho_s},
              {"alpha", model.alpha},
              {"beta", model.beta},
              {"gamma", model.gamma},
              {"alpha_x", model.alpha_x},
              {"alpha_y", model.alpha_y},
              {"ambient", {shading.ambient.x, shading.ambient.y, shading.ambient.z}}}},
            {"lights", lights},
            {"camera", camera_json(scene.camera)},
            {"views", views_json(scene.views)},
            {"size", fmt::format("{}x{}", scene.size[0], scene.size[1])},
            {"msaa", scene.samples == 4},
            {"exposure_stops", scene.exposure_stops},
            {"days", scene.days}};
}

Scene read_scene(const std::filesystem::path& path)
{
    return scene_of(read_json(path), path, path.string());
}

Scene scene_of(const json& root, const std::filesystem::path& path, const std::string& where)
{
    const std::string file = where + ": ";
    Fields fields(root, file);
    Scene scene;
    scene.head = beside(path, fields.text("head", ""));
    wound::Healing healing; // of every wound, unless it says otherwise
    if (const json* all = fields.get("healing"))
        healing = read_healing(*all, fields.where("healing"), path, healing);
    for (WoundScene& wound : scene.wounds)
        wound.healing = healing;
    if (const json* wounds = fields.get("wounds")) {
        if (!wounds->is_array() || wounds->size() > std::size_t(shared::MAX_WOUNDS))
            fields.fail("wounds", "is " + wounds->dump().substr(0, 60),
                        fmt::format("give an array of at most {} wounds", shared::MAX_WOUNDS));
        scene.wounds.clear();
        for (std::size_t i = 0; i < wounds->size(); ++i)
            scene.wounds.push_back(
                read_wound((*wounds)[i], fmt::format("{}/wounds/{}", file, i), path, healing));
    }
    scene.tissue = fields.text("tissue", scene.tissue);
    if (scene.tissue.ends_with(".json"))
        scene.tissue = beside(path, scene.tissue).string();
    scene.reflectance_model = read_rung(fields, scene.reflectance_model);
    if (const json* shading = fields.get("shading"))
        scene.shading = read_shading(*shading, file + "/shading", scene.shading);
    if (const json* lights = fields.get("lights")) {
        if (!lights->is_array() || lights->size() > std::size_t(shared::MAX_LIGHTS))
            fields.fail("lights", "is " + lights->dump().substr(0, 60),
                        fmt::format("give an array of at most {} lights", shared::MAX_LIGHTS));
        scene.lights.clear();
        for (std::size_t i = 0; i < lights->size(); ++i)
            scene.lights.push_back(read_light((*lights)[i], fmt::format("{}/lights/{}", file, i)));
    }
    if (const json* camera = fields.get("camera"))
        scene.camera = read_camera(*camera, file + "/camera");
    scene.views = read_views(fields, file);
    if (const json* size = fields.get("size"))
        scene.size = parse_size(size->is_string() ? size->get<std::string>() : size->dump(), file + "/size");
    scene.samples = fields.boolean("msaa", scene.samples == 4) ? 4 : 1;
    scene.exposure_stops = fields.number("exposure_stops", scene.exposure_stops, -20, 20);
    if (const json* days = fields.get("days"))
        scene.days = read_days(*days, file + "/days");
    fields.finish();
    return scene;
}

void save_scene(const std::filesystem::path& path, const Scene& scene)
{
    const std::filesystem::path folder = std::filesystem::absolute(path).lexically_normal().parent_path();
    const auto named_from_there = [&](const std::filesystem::path& file) {
        if (file.empty())
            return file;
        const std::filesystem::path whole = std::filesystem::absolute(file).lexically_normal();
        const std::filesystem::path relative = whole.lexically_relative(folder);
        return relative.empty() || *relative.begin() == ".." ? whole : relative;
    };
    Scene saved = scene;
    saved.head = named_from_there(scene.head);
    for (WoundScene& wound : saved.wounds) {
        wound.photo = named_from_there(wound.photo);
        wound.mask = named_from_there(wound.mask);
    }
    if (scene.tissue.ends_with(".json"))
        saved.tissue = named_from_there(scene.tissue).string();
    write_json(path, to_json(saved));
}

std::vector<double> parse_days(const std::string& text, const std::string& where)
{
    const std::string cure = "write \"first:last:step\" or days separated by commas, from 0 to 3650";
    const char separator = text.find(':') != std::string::npos ? ':' : ',';
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        double number = 0;
        const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, number);
        if (error != std::errc{} || stop != text.data() + end || !(number >= 0 && number <= 3650))
            throw cicatrix::InputError(
                where, "\"" + text + "\" holds no valid day at \"" + text.substr(begin, end - begin) + "\"",
                cure);
        numbers.push_back(number);
        begin = end + 1;
    }
    if (separator == ',')
        return numbers;
    if (numbers.size() != 3 || numbers[1] < numbers[0] || numbers[2] <= 0 ||
        (numbers[1] - numbers[0]) / numbers[2] > 10000)
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
    if (!cross || height.ec != std::errc{} || height.ptr != end ||
        std::ranges::any_of(size, [](auto s) { return s < 16 || s > 16384; }))
        throw cicatrix::InputError(where, "\"" + text + "\" is no picture size",
                                   "write WIDTHxHEIGHT, each from 16 to 16384, as in 1280x720");
    return size;
}

} // namespace app
