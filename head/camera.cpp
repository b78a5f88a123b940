#include "head/camera.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace head {
namespace {

glm::dvec3 up_of(const Camera& camera)
{
    const glm::dvec3 sight = camera.target - camera.eye;
    return std::abs(sight.y) > 0.999 * glm::length(sight) ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
}

} // namespace

glm::dmat4 view_from_world(const Camera& camera)
{
    return glm::lookAt(camera.eye, camera.target, up_of(camera));
}

glm::dvec3 sight_through(const Camera& camera, double x, double y, double aspect)
{
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up_of(camera)));
    const double half_height = std::tan(glm::radians(camera.fov_deg) / 2);
    return forward + half_height * (x * aspect * right - y * glm::cross(right, forward));
}

glm::dvec3 sight_through_pixel(const Camera& camera, const glm::dvec2& at_px, const cv::Size& size)
{
    return sight_through(camera, 2 * at_px.x / size.width - 1, 2 * at_px.y / size.height - 1,
                         double(size.width) / size.height);
}

} // namespace head
