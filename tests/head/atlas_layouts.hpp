// Meshes to be laid out on a skin atlas, and what must be true of every layout.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <utility>

#include "head/atlas.hpp"
#include "tests/support/ray_meshes.hpp"

namespace atlas_layouts {

using head::Atlas;
using head::AtlasTile;
using head::AtlasTriangle;
using head::BaseAtlas;
using head::Model;
using UvOf = std::function<glm::vec2(const glm::vec3& position)>;

inline constexpr double largest_gap = 1e-4; // of coordinates in units: float rounding

/// One opaque material of skin; each triangle with vertices of its own.
inline Model model_of(
    const ray_meshes::Mesh& mesh, const UvOf& uv_of = [](const glm::vec3&) { return glm::vec2(0); })
{
    Model model;
    for (const std::uint32_t index : mesh.indices) {
        const glm::vec3& p = mesh.positions[index];
        model.indices.push_back(std::uint32_t(model.vertices.size()));
        model.vertices.push_back(
            {.position = p, .normal = {0, 0, 1}, .tangent = {1, 0, 0, 1}, .uv = uv_of(p)});
    }
    model.primitives.push_back({0, std::uint32_t(model.indices.size()), 0});
    model.materials.push_back({.name = "skin"});
    head::update_bounds(model);
    return model;
}

/// A field of 20 cm that faces +z, of `cells` x `cells` squares, at this height over (x, y), m.
inline ray_meshes::Mesh field(int cells, const std::function<double(double x, double y)>& height)
{
    ray_meshes::Mesh mesh;
    const auto at = [&](int i, int j) {
        const double x = .2 * i / cells - .1, y = .2 * j / cells - .1;
        return glm::vec3(x, y, height(x, y));
    };
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            mesh.add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            mesh.add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    return mesh;
}
inline double flat(double, double)
{
    return 0;
}

inline glm::vec2 uv_of_field(const glm::vec3& p)
{
    return {5 * p.x + .5f, .5f - 5 * p.y};
}

inline BaseAtlas unwrapped(const Model& model)
{
    return head::unwrap(model, head::atlas_materials(model));
}

inline std::vector<const AtlasTile*> tiles_of(const Atlas& atlas)
{
    std::vector<const AtlasTile*> tiles;
    for (const auto* list : {&atlas.materials, &atlas.wounds})
        for (const AtlasTile& tile : *list)
            tiles.push_back(&tile);
    return tiles;
}

inline double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

/// The texels of an image at this scale whose centres lie well inside two home triangles, or in one outside
/// of its tile.
inline std::size_t texels_in_conflict(const Atlas& atlas, double scale)
{
    const int width = int(atlas.size.x * scale), height = int(atlas.size.y * scale);
    std::vector<std::uint8_t> covered(std::size_t(width) * std::size_t(height), 0);
    std::size_t conflicts = 0;
    for (const AtlasTile* tile : tiles_of(atlas))
        for (const AtlasTriangle& triangle : tile->home) {
            std::array<glm::dvec2, 3> p;
            glm::dvec2 low(1e9), high(-1e9);
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = glm::dvec2(triangle.at[k]) * scale;
                low = glm::min(low, p[k]);
                high = glm::max(high, p[k]);
            }
            if (cross(p[1] - p[0], p[2] - p[0]) < 0)
                std::swap(p[1], p[2]);
            const glm::dvec2 from = glm::dvec2(tile->corner) * scale - 1e-3,
                             to = glm::dvec2(tile->corner + tile->size) * scale + 1e-3;
            conflicts += low.x < from.x || low.y < from.y || high.x > to.x || high.y > to.y;
            for (int y = std::max(int(low.y), 0); y < std::min(int(high.y) + 1, height); ++y)
                for (int x = std::max(int(low.x), 0); x < std::min(int(high.x) + 1, width); ++x) {
                    bool inside = true;
                    for (std::size_t k = 0; k < 3; ++k) {
                        const glm::dvec2 edge = p[(k + 1) % 3] - p[k];
                        inside = inside &&
                                 cross(edge, glm::dvec2(x + .5, y + .5) - p[k]) > 1e-3 * glm::length(edge);
                    }
                    if (inside)
                        conflicts += std::exchange(covered[std::size_t(y) * width + x], 1);
                }
        }
    return conflicts;
}

/// How many homes each triangle has, by its first index.
inline std::map<std::uint32_t, int> homes(const Atlas& atlas)
{
    std::map<std::uint32_t, int> count;
    for (const AtlasTile* tile : tiles_of(atlas))
        for (const AtlasTriangle& triangle : tile->home)
            ++count[triangle.first];
    return count;
}

inline void expect_one_home_each(const Model& model, const Atlas& atlas)
{
    const auto count = homes(atlas);
    EXPECT_EQ(count.size() + atlas.left_out.size(), model.indices.size() / 3);
    for (const auto& [first, homes_of_it] : count)
        EXPECT_EQ(homes_of_it, 1) << first;
}

/// Ratio of the highest to the lowest density of the triangles in a tile.
inline double unevenness(const Model& model, const AtlasTile& tile)
{
    double low = 1e30, high = 0;
    for (const AtlasTriangle& t : tile.home) {
        const auto c = head::corners_of(model, t.first);
        const double area = glm::length(glm::cross(glm::dvec3(c[1] - c[0]), glm::dvec3(c[2] - c[0])));
        const double density = std::sqrt(std::abs(cross(t.at[1] - t.at[0], t.at[2] - t.at[0])) / area);
        low = std::min(low, density);
        high = std::max(high, density);
    }
    return high / low;
}

inline void expect_charted_anew(const Model& model, const char* fault)
{
    const BaseAtlas base = unwrapped(model);
    ASSERT_EQ(base.atlas.materials.size(), 1u);
    ASSERT_EQ(base.atlas.notes.size(), 1u);
    EXPECT_NE(base.atlas.notes[0].find(fault), std::string::npos) << base.atlas.notes[0];
    for (const double scale : {1., 4., 16.})
        EXPECT_EQ(texels_in_conflict(base.atlas, scale), 0u) << scale;
    expect_one_home_each(model, base.atlas);
    EXPECT_LT(unevenness(model, base.atlas.materials[0]), 2);
    EXPECT_GT(base.atlas.materials[0].gutter, 0);
}

/// Faces +z, x to the right.
inline head::Anchor anchor_at(double x, double y, double z, double width_m)
{
    head::Anchor anchor;
    anchor.centre = {x, y, z};
    anchor.half_width_m = width_m / 2;
    return anchor;
}

/// The place of a point of the model in the home triangles of a tile; none if it is not at home there.
inline std::optional<glm::dvec2> place_in(const Model& model, const AtlasTile& tile, const glm::dvec2& xy)
{
    for (const AtlasTriangle& triangle : tile.home) {
        const auto corners = head::corners_of(model, triangle.first);
        const glm::dvec2 a(corners[0]), b(corners[1]), c(corners[2]);
        const double all = cross(b - a, c - a), u = cross(xy - a, c - a) / all,
                     v = cross(b - a, xy - a) / all;
        if (u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9)
            return (1 - u - v) * glm::dvec2(triangle.at[0]) + u * glm::dvec2(triangle.at[1]) +
                   v * glm::dvec2(triangle.at[2]);
    }
    return std::nullopt;
}

inline void expect_tiles_apart(const Atlas& atlas)
{
    const auto tiles = tiles_of(atlas);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const AtlasTile& a = *tiles[i];
        EXPECT_TRUE(a.size.x == 0 ||
                    (a.corner.x + a.size.x <= atlas.size.x && a.corner.y + a.size.y <= atlas.size.y));
        EXPECT_EQ((a.corner.x | a.corner.y | a.size.x | a.size.y) % 4, 0u);
        for (std::size_t j = 0; j < i; ++j) {
            const AtlasTile& b = *tiles[j];
            EXPECT_TRUE(a.size.x == 0 || b.size.x == 0 || a.corner.x >= b.corner.x + b.size.x + 4 ||
                        b.corner.x >= a.corner.x + a.size.x + 4 || a.corner.y >= b.corner.y + b.size.y + 4 ||
                        b.corner.y >= a.corner.y + a.size.y + 4)
                << i << " and " << j;
        }
    }
}

} // namespace atlas_layouts
