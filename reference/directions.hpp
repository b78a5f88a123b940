// Directions: frames about a unit vector, and sampling about it.
#pragma once
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace reference {

/// Columns: two unit vectors across `axis`, and `axis`, which is unit. Duff et al. 2017, "Building an
/// orthonormal basis, revisited".
inline glm::dmat3 frame_about(const glm::dvec3& axis)
{
    const double s = std::copysign(1.0, axis.z), a = -1 / (s + axis.z), b = axis.x * axis.y * a;
    return {{1 + s * axis.x * axis.x * a, s * b, -s * axis.x}, {b, s + axis.y * axis.y * a, -axis.y}, axis};
}

/// Unit vector at an angle of this cosine from `axis`; `turn` in 0..1 is its azimuth.
inline glm::dvec3 direction_about(const glm::dvec3& axis, double cosine, double turn)
{
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), phi = 2 * std::numbers::pi * turn;
    return frame_about(axis) * glm::dvec3(sine * std::cos(phi), sine * std::sin(phi), cosine);
}

} // namespace reference
