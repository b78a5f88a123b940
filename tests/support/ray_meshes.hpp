// Test meshes for ray intersection, and a brute-force reference that tests every triangle.
#pragma once
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "head/bvh.hpp"

namespace ray_meshes {

using glm::dvec3;
using head::Bvh;
using head::Facing;
using head::Hit;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Mesh
{
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
    {
        for (const glm::vec3& p : {a, b, c}) {
            indices.push_back(std::uint32_t(positions.size()));
            positions.push_back(p);
        }
    }
    dvec3 corner(std::size_t index) const { return dvec3(positions[indices[index]]); }
    Bvh bvh() const { return {positions, indices}; }
};

struct Ray
{
    dvec3 origin, direction;
};

/// Moeller & Trumbore 1997, as used for the head's surface before the hierarchy existed.
inline std::optional<Hit> intersect(const Mesh& mesh, std::uint32_t first, const Ray& ray, Facing facing)
{
    const dvec3 a = mesh.corner(first), ab = mesh.corner(first + 1) - a, ac = mesh.corner(first + 2) - a;
    const dvec3 p = glm::cross(ray.direction, ac);
    const double det = glm::dot(ab, p);
    if ((facing == Facing::Front ? det : std::abs(det)) <= 1e-18)
        return std::nullopt;
    const dvec3 s = ray.origin - a;
    const double u = glm::dot(s, p) / det;
    const dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(ray.direction, q) / det;
    if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9)
        return std::nullopt;
    return Hit{first, 0, 0, det > 0, glm::dot(ac, q) / det, u, v};
}

inline std::optional<Hit> nearest_by_brute_force(const Mesh& mesh, const Ray& ray, double tmin, double tmax,
                                                 Facing facing)
{
    std::optional<Hit> nearest;
    for (std::uint32_t i = 0; i < mesh.indices.size(); i += 3)
        if (const auto hit = intersect(mesh, i, ray, facing); hit && hit->distance >= tmin &&
                                                              hit->distance <= tmax &&
                                                              (!nearest || hit->distance < nearest->distance))
            nearest = hit;
    return nearest;
}

inline bool same(const std::optional<Hit>& a, const std::optional<Hit>& b)
{
    if (!a || !b)
        return !a && !b;
    return a->triangle == b->triangle && a->front == b->front && a->distance == b->distance && a->u == b->u &&
           a->v == b->v;
}

/// Counts the rays that hit and the rays for which the hierarchy and brute force disagree.
struct Comparison
{
    int rays = 0, hits = 0, different = 0;

    void add(const Mesh& mesh, const Bvh& bvh, const Ray& ray, double tmin = 0, double tmax = infinity)
    {
        for (const Facing facing : {Facing::Both, Facing::Front}) {
            const auto expected = nearest_by_brute_force(mesh, ray, tmin, tmax, facing);
            ++rays;
            hits += expected.has_value();
            different += !same(bvh.nearest(ray.origin, ray.direction, tmin, tmax, facing), expected);
        }
        different += bvh.any(ray.origin, ray.direction, tmax) !=
                     nearest_by_brute_force(mesh, ray, 0, tmax, Facing::Both).has_value();
    }
};

class Dice
{
  public:
    double number(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
    dvec3 in_cube(double half) { return {number(-half, half), number(-half, half), number(-half, half)}; }
    dvec3 on_sphere()
    {
        const double z = number(-1, 1), angle = number(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

  private:
    std::mt19937 engine_{7};
};

/// Triangles of all sizes, some of them needles.
inline Mesh soup(int triangles)
{
    Dice dice;
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const double size = std::pow(10, dice.number(-3, -0.5));
        const dvec3 a = dice.in_cube(0.2), b = a + dice.in_cube(size);
        const dvec3 c = i % 5 == 0 ? a + 1.001 * (b - a) + dice.in_cube(1e-5) : a + dice.in_cube(size);
        mesh.add(glm::vec3(a), glm::vec3(b), glm::vec3(c));
    }
    return mesh;
}

/// A closed sphere about the origin, radius 10 cm, counter-clockwise from outside, vertices shared.
inline Mesh sphere(std::uint32_t rings = 24, std::uint32_t sectors = 48)
{
    Mesh mesh;
    const auto index = [&](std::uint32_t ring, std::uint32_t sector) {
        return ring == 0 ? 0 : ring == rings ? 1 : 2 + (ring - 1) * sectors + sector % sectors;
    };
    mesh.positions = {{0, 0.1f, 0}, {0, -0.1f, 0}};
    for (std::uint32_t ring = 1; ring < rings; ++ring)
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            const double down = std::numbers::pi * ring / rings,
                         around = 2 * std::numbers::pi * sector / sectors;
            mesh.positions.emplace_back(
                glm::vec3(0.1 * dvec3(std::sin(down) * std::sin(around), std::cos(down),
                                      std::sin(down) * std::cos(around))));
        }
    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            const std::uint32_t a = index(ring, sector), b = index(ring + 1, sector),
                                c = index(ring, sector + 1), d = index(ring + 1, sector + 1);
            if (ring > 0)
                mesh.indices.insert(mesh.indices.end(), {a, b, c});
            if (ring + 1 < rings)
                mesh.indices.insert(mesh.indices.end(), {c, b, d});
        }
    return mesh;
}

/// Squares of 2 cm that face +z, at these heights, two triangles each.
inline Mesh squares(const std::vector<float>& heights)
{
    Mesh mesh;
    for (const float z : heights) {
        mesh.add({-0.01f, -0.01f, z}, {0.01f, -0.01f, z}, {0.01f, 0.01f, z});
        mesh.add({-0.01f, -0.01f, z}, {0.01f, 0.01f, z}, {-0.01f, 0.01f, z});
    }
    return mesh;
}

} // namespace ray_meshes
