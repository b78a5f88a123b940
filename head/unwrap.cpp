// The atlas of a head without wounds: whether the file's texture coordinates can serve, and the tiles' sizes.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

#include "head/atlas.hpp"
#include "head/charts.hpp"
#include "head/flat_triangles.hpp"
#include "head/materials.hpp"
#include "head/packing.hpp"

namespace head {
namespace {

constexpr std::uint32_t largest_side = 256, smallest_side = 16, grain = 4; // units; of the tiles
constexpr double no_area = 1e-12;                                          // m^2, of a triangle

// What the file's texture coordinates must satisfy.
constexpr double widest_range = 4;         // from the lowest to the highest coordinate
constexpr double most_overlap = .002;      // share of the texels
constexpr double least_covered = .15;      // share of the bounding box
constexpr double most_without_area = .005; // share of the surface that has no area in texture coordinates
constexpr double least_relative_density = 1. / 8;   // 5th percentile of the density relative to its median
constexpr int texels_checked = 1024;                // along the box's longer side
constexpr std::size_t most_rows_checked = 1u << 25; // over all triangles: bounds the time

/// The triangles of one material on the atlas.
struct Skin
{
    std::string name;
    std::vector<std::uint32_t> triangles; // first indices
    std::vector<double> areas;            // m^2
    double area = 0;                      // m^2, of all
};

Skin skin_of(const Model& model, std::uint32_t material, std::vector<std::uint32_t>& left_out)
{
    Skin skin{model.materials[material].name, {}, {}, 0};
    for (const Primitive& primitive : model.primitives)
        for (std::uint32_t i = 0; primitive.material == material && i + 2 < primitive.index_count; i += 3) {
            const std::uint32_t first = primitive.first_index + i;
            const auto corners = corners_of(model, first);
            const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
            const double area = glm::length(glm::cross(b - a, c - a)) / 2;
            if (!(area > no_area) || !std::isfinite(area)) {
                left_out.push_back(first);
                continue;
            }
            skin.triangles.push_back(first);
            skin.areas.push_back(area);
            skin.area += area;
        }
    return skin;
}

FlatTriangle uvs_of(const Model& model, std::uint32_t first)
{
    FlatTriangle uvs;
    for (std::uint32_t k = 0; k < 3; ++k)
        uvs[k] = glm::dvec2(model.vertices[model.indices[first + k]].uv);
    return uvs;
}

Box2 box_of_uvs(const Model& model, const Skin& skin)
{
    Box2 box;
    for (const std::uint32_t first : skin.triangles)
        for (const glm::dvec2& uv : uvs_of(model, first))
            box.add(uv);
    return box;
}

/// sqrt(area on the plane / area), weighted with the area.
std::vector<Weighted> densities(const Skin& skin, std::span<const FlatTriangle> flat)
{
    std::vector<Weighted> result(flat.size());
    for (std::size_t i = 0; i < flat.size(); ++i)
        result[i] = {std::sqrt(std::abs(signed_area(flat[i])) / skin.areas[i]), skin.areas[i]};
    return result;
}

/// Of an image of this size, and triangles in texels: the shares of it that are covered, and of these covered
/// twice. Stops early when they overlap heavily.
struct Coverage
{
    double covered = 0, overlap = 0;
};
Coverage coverage_of(std::span<const FlatTriangle> flat, const glm::ivec2& size)
{
    std::vector<std::uint8_t> image(std::size_t(size.x) * size.y, 0);
    std::size_t covered = 0, again = 0, rows = 0;
    for (const FlatTriangle& triangle : flat) {
        if (again > image.size() || ++rows > most_rows_checked)
            return {1, 1};
        for_each_texel_row(triangle, size, [&](int row, int begin, int end) {
            ++rows;
            for (int x = begin; x < end; ++x)
                ++(std::exchange(image[std::size_t(row) * size.x + x], 1) != 0 ? again : covered);
            return again <= image.size();
        });
    }
    return {double(covered) / double(image.size()),
            double(again) / double(std::max<std::size_t>(covered, 1))};
}

/// Why the texture coordinates cannot serve; empty if they can.
std::string fault_of_uvs(const Model& model, const Skin& skin)
{
    for (const std::uint32_t first : skin.triangles)
        for (const glm::dvec2& uv : uvs_of(model, first))
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
                return "are not all finite";
    const Box2 box = box_of_uvs(model, skin);
    const glm::dvec2 range = box.high - box.low;
    const double longer = std::max(range.x, range.y);
    if (longer > widest_range)
        return fmt::format("range over {:.3g} x {:.3g}", range.x, range.y);
    if (std::min(range.x, range.y) < 1e-6)
        return "are missing";
    std::vector<FlatTriangle> flat;
    for (const std::uint32_t first : skin.triangles) {
        flat.push_back(uvs_of(model, first));
        for (glm::dvec2& uv : flat.back())
            uv = (uv - box.low) / longer * double(texels_checked);
    }
    const std::vector<Weighted> density = densities(skin, flat);
    const double median = weighted_quantile(density, .5), low = weighted_quantile(density, .05);
    double without = 0;
    for (const Weighted& d : density)
        without += d.value <= 1e-3 * median ? d.weight : 0;
    if (without > most_without_area * skin.area)
        return fmt::format("have no area on {:.1f} % of the surface", 100 * without / skin.area);
    if (low < least_relative_density * median)
        return "differ too much in density";
    const glm::ivec2 size = glm::max(glm::ivec2(glm::ceil(range / longer * double(texels_checked))), 1);
    const Coverage coverage = coverage_of(flat, size);
    if (coverage.overlap > most_overlap)
        return coverage.overlap >= 1
                   ? "overlap"
                   : fmt::format("overlap on {:.1f} % of the texels", 100 * coverage.overlap);
    if (coverage.covered < least_covered)
        return fmt::format("cover only {:.0f} % of their range", 100 * coverage.covered);
    return {};
}

std::uint32_t rounded_side(double units)
{
    return std::clamp(std::uint32_t(std::ceil(std::clamp(units, 1., 1e4) / grain - 1e-6)) * grain,
                      smallest_side, largest_side);
}

/// The file's coordinates, scaled so that the longer side has `longer_side` units.
void keep_uvs(AtlasTile& tile, const Model& model, const Skin& skin, double longer_side)
{
    const Box2 box = box_of_uvs(model, skin);
    const glm::dvec2 range = box.high - box.low, units = range / std::max(range.x, range.y) * longer_side;
    tile.size = {rounded_side(units.x), rounded_side(units.y)};
    for (const std::uint32_t first : skin.triangles) {
        AtlasTriangle triangle{first, {}};
        const FlatTriangle uvs = uvs_of(model, first);
        for (std::size_t k = 0; k < 3; ++k)
            triangle.at[k] = glm::vec2((uvs[k] - box.low) / range * glm::dvec2(tile.size));
        tile.home.push_back(triangle);
    }
}

double density_of(const AtlasTile& tile, const Skin& skin)
{
    std::vector<FlatTriangle> flat;
    for (const AtlasTriangle& triangle : tile.home)
        flat.push_back({triangle.at[0], triangle.at[1], triangle.at[2]});
    return weighted_quantile(densities(skin, flat), .5);
}

/// A tile at about this density, in units per m; as large as may be if it is infinite.
AtlasTile tile_of(const Model& model, const Skin& skin, double units_per_m, std::vector<std::string>& notes)
{
    AtlasTile tile;
    const std::string fault = fault_of_uvs(model, skin);
    const auto lay_out = [&](std::uint32_t side) {
        tile = {};
        if (fault.empty())
            keep_uvs(tile, model, skin, side);
        else
            chart_anew(tile, model, skin.triangles, side);
        tile.units_per_m = density_of(tile, skin);
    };
    lay_out(largest_side);
    if (tile.units_per_m > units_per_m)
        lay_out(rounded_side(largest_side * units_per_m / tile.units_per_m));
    if (!fault.empty())
        notes.push_back(
            fmt::format("texture coordinates of material \"{}\" {}: the light map has charts of its own",
                        skin.name, fault));
    return tile;
}

/// Puts the tiles, which start at (0, 0), beside and below each other.
void place_tiles(Atlas& atlas)
{
    Horizon horizon(largest_side / grain + 1); // with the gap beyond the right edge
    std::vector<Horizon::Span> outline;
    for (AtlasTile& tile : atlas.materials) {
        outline.assign(tile.size.x / grain + 1, {0, double(tile.size.y / grain + 1)});
        const auto place = horizon.put(outline);
        tile.corner = glm::uvec2(place->column, std::uint32_t(place->height)) * grain;
        atlas.size = glm::max(atlas.size, tile.corner + tile.size);
        for (AtlasTriangle& triangle : tile.home)
            for (glm::vec2& at : triangle.at)
                at += glm::vec2(tile.corner);
    }
    if (!atlas.materials.empty())
        atlas.size.x = largest_side;
}

glm::vec4 ball_around(const std::array<glm::vec3, 3>& corners)
{
    const glm::vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.f;
    float radius = 0;
    for (const glm::vec3& corner : corners)
        radius = std::max(radius, glm::distance(corner, centre));
    return {centre, radius * 1.0001f};
}

} // namespace

std::vector<std::uint32_t> atlas_materials(const Model& model)
{
    std::vector<std::uint32_t> materials;
    const std::uint32_t skin = skin_material(model);
    for (std::uint32_t m = 0; m < model.materials.size(); ++m)
        if (surface_of(model, m, skin) == Surface::Skin && model.materials[m].alpha == AlphaMode::Opaque)
            materials.push_back(m);
    return materials;
}

BaseAtlas unwrap(const Model& model, std::span<const std::uint32_t> materials)
{
    BaseAtlas base;
    Atlas& atlas = base.atlas;
    std::vector<Skin> skins;
    for (const std::uint32_t material : materials)
        skins.push_back(skin_of(model, material, atlas.left_out));
    std::erase_if(skins, [](const Skin& skin) { return skin.triangles.empty(); });
    std::ranges::stable_sort(skins, std::ranges::greater(), &Skin::area);
    double units_per_m = std::numeric_limits<double>::infinity();
    for (const Skin& skin : skins) {
        atlas.materials.push_back(tile_of(model, skin, units_per_m, atlas.notes));
        units_per_m = atlas.materials.front().units_per_m;
    }
    place_tiles(atlas);
    for (const AtlasTile& tile : atlas.materials)
        for (const AtlasTriangle& triangle : tile.home)
            base.bounds.push_back(ball_around(corners_of(model, triangle.first)));
    return base;
}

} // namespace head
