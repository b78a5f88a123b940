#include "apps/scene_camera.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

#include "wound/input_error.hpp"

namespace app {
using nlohmann::json;

Direction read_direction(Fields& fields, const Direction& fallback)
{
    return {fields.number("azimuth_deg", fallback.azimuth_deg, -180, 180),
            fields.number("elevation_deg", fallback.elevation_deg, -89, 89)};
}

namespace {

CameraScene camera_fields(Fields& fields)
{
    CameraScene camera;
    camera.from = read_direction(fields, camera.from);
    camera.distance_m = fields.number("distance_m", camera.distance_m, 0, 100);
    camera.fov_deg = fields.number("fov_deg", camera.fov_deg, 1, 120);
    camera.target_m = fields.numbers<3>("target_m", camera.target_m, -1, 1);
    return camera;
}

ViewScene read_view(const json& value, const std::string& where)
{
    if (value.is_string())
        return {value.get<std::string>(), std::nullopt};
    Fields fields(value, where);
    ViewScene view{fields.text("name", ""), std::nullopt};
    const bool fit = std::ranges::all_of(
        view.name, [](unsigned char c) { return c < 128 && (std::isalnum(c) || c == '-' || c == '_'); });
    if (view.name.empty() || view.name.size() > 40 || !fit)
        fields.fail("name", "is \"" + view.name + "\"",
                    "give the view a name of letters, digits, - and _, for it goes into names of files");
    view.camera = camera_fields(fields);
    fields.finish();
    return view;
}

} // namespace

CameraScene read_camera(const json& object, const std::string& where)
{
    Fields fields(object, where);
    const CameraScene camera = camera_fields(fields);
    fields.finish();
    return camera;
}

std::vector<ViewScene> read_views(Fields& fields, const std::string& file)
{
    std::vector<ViewScene> views;
    const json* list = fields.get("views");
    if (list == nullptr)
        return views;
    if (!list->is_array() || list->size() > 64)
        fields.fail("views", "is " + list->dump().substr(0, 60), "give an array of at most 64 views");
    for (std::size_t i = 0; i < list->size(); ++i) {
        const std::string where = fmt::format("{}/views/{}", file, i);
        views.push_back(read_view((*list)[i], where));
        if (std::ranges::count(views, views.back().name, &ViewScene::name) > 1)
            throw cicatrix::InputError(where, "is called \"" + views.back().name + "\" as another one is",
                                       "give each view a name of its own");
    }
    return views;
}

json camera_json(const CameraScene& camera)
{
    return {{"azimuth_deg", camera.from.azimuth_deg},
            {"elevation_deg", camera.from.elevation_deg},
            {"distance_m", camera.distance_m},
            {"fov_deg", camera.fov_deg},
            {"target_m", camera.target_m}};
}

json views_json(const std::vector<ViewScene>& views)
{
    json result = json::array();
    for (const ViewScene& view : views) {
        if (!view.camera) {
            result.push_back(view.name);
            continue;
        }
        result.push_back(camera_json(*view.camera));
        result.back()["name"] = view.name;
    }
    return result;
}

} // namespace app
