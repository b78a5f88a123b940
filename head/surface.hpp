// Points on a head's surface: what a ray meets, what lies nearest.
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

/// The first front face on a ray. `solid`: the hierarchy of the head's solid triangles, so that hair and
/// lashes are looked through. `direction`: of any length.
std::optional<SurfacePoint> first_on_ray(const Bvh& solid, const glm::dvec3& origin,
                                         const glm::dvec3& direction);

/// The point of the surface nearest to `point`, hair left out.
SurfacePoint nearest_on_surface(const Model& head, const glm::dvec3& point);

} // namespace head
