// A camera that looks at a head.
#pragma once
#include <glm/glm.hpp>
#include <opencv2/core.hpp>

namespace head {

struct Camera
{
    glm::dvec3 eye{0, 0, 1}, target{0, 0, 0}; // metres
    double fov_deg = 20;                      // vertical
    bool operator==(const Camera&) const = default;
};

/// World to camera coordinates: x right, y up, z towards the viewer.
glm::dmat4 view_from_world(const Camera& camera);

/// Direction, not normalised, from the eye through a point of the picture: x from -1 (left) to 1, y from -1
/// (top) to 1. `aspect`: width / height.
glm::dvec3 sight_through(const Camera& camera, double x, double y, double aspect);

/// The same through a place of a picture in pixels, from its top left corner.
glm::dvec3 sight_through_pixel(const Camera& camera, const glm::dvec2& at_px, const cv::Size& size);

} // namespace head
