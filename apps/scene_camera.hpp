// The cameras of a scene file: its own and its further views.
#pragma once
#include <string>
#include <vector>

#include "apps/json_fields.hpp"
#include "apps/scene.hpp"

namespace app {

// All throw cicatrix::InputError naming file and field.
Direction read_direction(Fields& fields, const Direction& fallback);
CameraScene read_camera(const nlohmann::json& object, const std::string& where);
/// The scene's field `views`; none when it is absent.
std::vector<ViewScene> read_views(Fields& scene, const std::string& file);

nlohmann::json camera_json(const CameraScene& camera);
nlohmann::json views_json(const std::vector<ViewScene>& views);

} // namespace app
