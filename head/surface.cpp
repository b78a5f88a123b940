#include "head/surface.hpp"

#include <array>
#include <limits>

namespace head {
namespace {

/// Ericson 2004, Real-Time Collision Detection, 5.1.5: by the Voronoi region of the triangle that holds p.
glm::dvec3 nearest_in_triangle(const std::array<glm::vec3, 3>& t, const glm::dvec3& p)
{
    const glm::dvec3 a(t[0]), b(t[1]), c(t[2]), ab = b - a, ac = c - a;
    const double d1 = glm::dot(ab, p - a), d2 = glm::dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0)
        return a;
    const double d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3)
        return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return a + d1 / (d1 - d3) * ab;
    const double d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6)
        return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return a + d2 / (d2 - d6) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6)
        return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    const double whole = va + vb + vc;
    return a + vb / whole * ab + vc / whole * ac;
}

/// Calls `visit(corners, material)` for every triangle that is not hair.
template <typename Visit>
void for_each_triangle(const Model& head, const Visit& visit)
{
    for (const Primitive& primitive : head.primitives) {
        if (head.materials[primitive.material].alpha == AlphaMode::Blend)
            continue;
        for (std::size_t i = primitive.first_index;
             i + 2 < std::size_t(primitive.first_index) + primitive.index_count; i += 3)
            visit(corners_of(head, i), primitive.material);
    }
}

} // namespace

std::optional<SurfacePoint> first_on_ray(const Bvh& solid, const glm::dvec3& origin,
                                         const glm::dvec3& direction)
{
    const auto hit =
        solid.nearest(origin, direction, 0, std::numeric_limits<double>::infinity(), Facing::Front);
    if (!hit)
        return std::nullopt;
    return SurfacePoint{origin + hit->distance * direction, hit->material};
}

SurfacePoint nearest_on_surface(const Model& head, const glm::dvec3& point)
{
    SurfacePoint found;
    double nearest = std::numeric_limits<double>::max();
    for_each_triangle(head, [&](const std::array<glm::vec3, 3>& corners, std::uint32_t material) {
        const glm::dvec3 at = nearest_in_triangle(corners, point);
        const double distance = glm::dot(at - point, at - point);
        if (distance >= nearest)
            return;
        nearest = distance;
        found = {at, material};
    });
    return found;
}

} // namespace head
