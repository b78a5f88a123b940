// Points on a head's surface: what a ray meets, what lies nearest.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "head/model.hpp"

namespace head {

/// The three corners of the triangle whose first index is at `first`.
std::array<glm::vec3, 3> corners_of(const Model& head, std::size_t first);

struct SurfacePoint
{
    glm::dvec3 at{0.0}; // metres
    std::uint32_t material = 0;
};

/// The first front face on a ray. Hair and lashes (blended materials) are looked through. `direction`: of any
/// length. Every triangle is looked at: half a millisecond for a head of 38 000.
std::optional<SurfacePoint> first_on_ray(const Model& head, const glm::dvec3& origin,
                                         const glm::dvec3& direction);

/// The point of the surface nearest to `point`, hair left out.
SurfacePoint nearest_on_surface(const Model& head, const glm::dvec3& point);

} // namespace head
