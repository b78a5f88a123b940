#include "apps/demo/camera_moves.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace demo_command {

scene::Camera orbit(scene::Camera camera, double right_deg, double up_deg)
{
    camera.from.azimuth_deg = std::remainder(camera.from.azimuth_deg + right_deg, 360.0);
    camera.from.elevation_deg = std::clamp(camera.from.elevation_deg + up_deg, -89.0, 89.0);
    return camera;
}

scene::Camera zoom(scene::Camera camera, double factor, double distance_m)
{
    camera.distance_m = std::clamp(distance_m / factor, 0.03, 10.0);
    return camera;
}

scene::Camera pan(scene::Camera camera, double right, double down, double distance_m)
{
    const double azimuth = glm::radians(camera.from.azimuth_deg),
                 elevation = glm::radians(camera.from.elevation_deg);
    const glm::dvec3 towards(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                             std::cos(azimuth) * std::cos(elevation));
    const glm::dvec3 across = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), towards));
    const glm::dvec3 up = glm::cross(towards, across);
    const double height_m = 2 * distance_m * std::tan(glm::radians(camera.fov_deg) / 2);
    const glm::dvec3 step = height_m * (down * up - right * across); // the camera moves opposite to the mouse
    for (int i = 0; i < 3; ++i)
        camera.target_m[std::size_t(i)] = std::clamp(camera.target_m[std::size_t(i)] + step[i], -1.0, 1.0);
    return camera;
}

} // namespace demo_command
