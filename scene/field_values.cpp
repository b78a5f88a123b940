#include "scene/field_values.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"
#include "base/json_fields.hpp"
#include "scene/field_builders.hpp"
#include "scene/file.hpp"

namespace scene {
using nlohmann::json;

// ---- Values without a builder
// ---------------------------------------------------------------------------

head::Place read_place(base::Fields& fields, const head::Place& fallback)
{
    const json* value = fields.get("at");
    if (value == nullptr)
        return fallback;
    if (value->is_string())
        return value->get<std::string>();
    if (value->is_array() && value->size() == 2) {
        const auto at = fields.numbers<2>("at", {}, -3, 3);
        return head::FacePoint{at[0], at[1]};
    }
    if (value->is_array() && value->size() == 3) {
        const auto at = fields.numbers<3>("at", {}, -10, 10);
        return glm::dvec3(at[0], at[1], at[2]);
    }
    fields.fail("at", "is " + value->dump(),
                "give a named place, face coordinates [x, y] or a point [x, y, z] in metres");
}

json place_json(const head::Place& place)
{
    if (const auto* name = std::get_if<std::string>(&place))
        return *name;
    if (const auto* face = std::get_if<head::FacePoint>(&place))
        return {face->x, face->y};
    const glm::dvec3& point = std::get<glm::dvec3>(place);
    return {point.x, point.y, point.z};
}

json hints_json(const wound::SegmentationHints& hints)
{
    json object = json::object();
    if (hints.rect)
        object["rect"] = {hints.rect->x, hints.rect->y, hints.rect->width, hints.rect->height};
    if (hints.seed)
        object["seed"] = {hints.seed->x, hints.seed->y};
    return object;
}

std::vector<double> read_days(const json& value, const std::string& where)
{
    if (value.is_string())
        return parse_days(value.get<std::string>(), where);
    if (value.is_number())
        return parse_days(value.dump(), where);
    if (!value.is_array() || value.empty())
        throw base::InputError(where, "is " + value.dump(), "write \"0:30:3\" or an array of days");
    std::string text;
    for (const json& day : value)
        text += (text.empty() ? "" : ",") + day.dump();
    return parse_days(text, where);
}

namespace {

View read_view(const json& value, const std::string& where, Reading& reading)
{
    if (value.is_string())
        return {value.get<std::string>(), std::nullopt};
    base::Fields fields(value, where);
    View view{fields.text("name", ""), std::nullopt};
    const bool fit = std::ranges::all_of(
        view.name, [](unsigned char c) { return c < 128 && (std::isalnum(c) || c == '-' || c == '_'); });
    if (view.name.empty() || view.name.size() > 40 || !fit)
        fields.fail("name", "is \"" + view.name + "\"",
                    "give at most 40 letters, digits, - and _: the name becomes part of file names");
    Camera camera;
    for (const Field<Camera>& field : camera_fields())
        field.read(fields, camera, reading);
    view.camera = camera;
    fields.finish();
    return view;
}

} // namespace

void read_views(base::Fields& fields, std::vector<View>& views, Reading& reading)
{
    const json* list = fields.get("views");
    if (list == nullptr)
        return;
    if (!list->is_array() || list->size() > 64)
        fields.fail("views", "is " + list->dump().substr(0, 60), "give an array of at most 64 views");
    for (std::size_t i = 0; i < list->size(); ++i) {
        const std::string where = fmt::format("{}/{}", fields.where("views"), i);
        views.push_back(read_view((*list)[i], where, reading));
        if (std::ranges::count(views, views.back().name, &View::name) > 1)
            throw base::InputError(where, "has the name \"" + views.back().name + "\" of another view",
                                   "give each view a different name");
    }
}

json views_json(const std::vector<View>& views)
{
    json result = json::array();
    for (const View& view : views) {
        if (!view.camera) {
            result.push_back(view.name);
            continue;
        }
        result.push_back(object_json(camera_fields(), *view.camera));
        result.back()["name"] = view.name;
    }
    return result;
}

wound::SegmentationHints read_hints(const json& object, const std::string& where)
{
    constexpr double most_pixels = 1 << 20; // segment() checks them against the photograph's size
    base::Fields fields(object, where);
    wound::SegmentationHints hints;
    if (fields.has("rect")) {
        const auto rect = fields.numbers<4>("rect", {}, 0, most_pixels);
        hints.rect = cv::Rect(int(rect[0]), int(rect[1]), int(rect[2]), int(rect[3]));
    }
    if (fields.has("seed")) {
        const auto seed = fields.numbers<2>("seed", {}, 0, most_pixels);
        hints.seed = cv::Point(int(seed[0]), int(seed[1]));
    }
    fields.finish();
    return hints;
}

namespace {

/// The fields of a healing that make up its course.
constexpr std::array course_fields{"gamma", "delta", "theta", "residual_border", "age_days"};

/// Whether the object says something of the curve.
bool says_curve(const json* healing)
{
    return healing != nullptr && healing->is_object() &&
           std::ranges::any_of(std::array{"areas", "series", "gamma", "delta", "theta"},
                               [&](const char* field) { return healing->contains(field); });
}

} // namespace

void read_healing(Wound& wound, const json* own, const std::string& where, Reading& reading)
{
    wound.healing = usual_healing(wound);
    if (says_curve(reading.healing_of_all) || says_curve(own))
        wound.healing.curve = {};
    if (reading.healing_of_all != nullptr)
        read_object(healing_fields(), *reading.healing_of_all, reading.where_of_all, wound.healing, reading);
    if (own != nullptr)
        read_object(healing_fields(), *own, where, wound.healing, reading);
}

json healing_json(const Wound& wound)
{
    json written = object_json(healing_fields(), wound.healing);
    wound::Healing usual = usual_healing(wound);
    usual.model = wound.healing.model;
    if (wound.healing == usual)
        for (const char* field : course_fields)
            written.erase(field);
    return written;
}

// ---- Rules that involve several fields of one object
// --------------------------------------------------------------------

void check_object(base::Fields& fields, const Wound& wound)
{
    if (!wound.mask.empty() && wound.photo.empty())
        fields.fail("mask", "is given without a photo", "name the photo it belongs to");
    if (wound.segmentation.any() && wound.photo.empty())
        fields.fail("segmentation", "is given without a photo", "name the photo in which to look");
    if (wound.segmentation.any() && !wound.mask.empty())
        fields.fail("segmentation", "is given together with a mask", "give one of the two");
}

void check_object(base::Fields& fields, const Light& light)
{
    if (const double brightest = light.intensity * *std::ranges::max_element(light.color); brightest > 1e4)
        fields.fail("intensity", fmt::format("times the color is {}", base::plain(brightest)),
                    "reduce the product to at most 1e4");
}

} // namespace scene
