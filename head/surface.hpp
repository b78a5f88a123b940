// Points on a head's surface: the first hit of a ray and the point nearest to another.
#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "head/bvh.hpp"
#include "head/model.hpp"

namespace head {

struct SurfacePoint
{
    glm::dvec3 at{0.0}; // metres
    std::uint32_t material = 0;
};

/// The first front-facing hit of a ray. `solid`: the hierarchy of the head's solid triangles, so that rays
/// pass through hair and lashes. `direction`: of any length.
std::optional<SurfacePoint> first_on_ray(const Bvh& solid, const glm::dvec3& origin,
                                         const glm::dvec3& direction);

/// The point of the surface nearest to `point`, ignoring hair.
SurfacePoint nearest_on_surface(const Model& head, const glm::dvec3& point);

} // namespace head
