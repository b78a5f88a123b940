#include "stage/camera_record.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/file.hpp"

namespace stage {
namespace {
using nlohmann::json;

json rows_of(const glm::dmat4& matrix)
{
    json rows = json::array();
    for (int row = 0; row < 4; ++row)
        rows.push_back({matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]});
    return rows;
}

} // namespace

json camera_record(const Stage& stage, const head::Camera& camera, std::array<std::uint32_t, 2> size)
{
    const double focal = size[1] / 2.0 / std::tan(glm::radians(camera.fov_deg) / 2);
    // Converts from OpenGL's camera axes (y up, looking along -z) to those of computer vision.
    const glm::dmat4 camera_from_world =
        glm::scale(glm::dmat4(1), glm::dvec3(1, -1, -1)) * head::view_from_world(camera);
    return {{"eye", scene::numbers_of(camera.eye)},
            {"target", scene::numbers_of(camera.target)},
            {"fov_deg", camera.fov_deg},
            {"clip_from_world",
             rows_of(glm::dmat4(stage.view(camera, passes::ViewportTile(size)).clip_from_world))},
            {"camera_from_world", rows_of(camera_from_world)},
            {"intrinsics", {{"fx", focal}, {"fy", focal}, {"cx", size[0] / 2.0}, {"cy", size[1] / 2.0}}}};
}

} // namespace stage
