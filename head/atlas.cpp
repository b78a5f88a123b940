#include "head/atlas.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "head/flat_triangles.hpp"
#include "head/packing.hpp"

namespace head {
namespace {

// In half widths of the patch.
constexpr double usual_tile_reach = 1.24; // from the patch's centre to the tile's edge
constexpr double deepest_margin = 2.; // height of margin triangles over the patch's plane, or depth under it

constexpr double least_facing_home = .2,
                 least_facing_margin = .05; // cosine of the angle to the anchor's normal
constexpr double wound_density = 2;         // relative to the base tile
constexpr double border = 1;                // units, in the tile, without home triangles
constexpr std::uint32_t wound_grain = 4, narrowest_wound = 16, widest_wound = 160; // units
constexpr std::uint32_t most_height = 1024; // units: images of at most 16384 texels

/// Half widths from the patch's centre to the tile's edge. Beside a small patch there is room for a triangle
/// of a usual mesh: one that sticks out of the tile has no place on the atlas.
double tile_reach(const Anchor& anchor)
{
    constexpr double least_margin_m = .0045;
    return std::max(usual_tile_reach, 1 + least_margin_m / anchor.half_width_m);
}

/// A triangle around an anchor.
struct Projected
{
    std::uint32_t number = 0;       // in BaseAtlas::bounds
    std::uint32_t first = 0;        // of model.indices
    std::array<glm::dvec3, 3> at{}; // in_frame()
    double facing = 0, height = 0;  // cosine; of its centre, half widths
    double area = 0, density = 0;   // m^2; units per m in its base tile
    bool received = false;
};

using Places = std::vector<const AtlasTriangle*>; // in the base tiles, by number

Projected project(const Model& model, const Anchor& anchor, const AtlasTriangle& base, std::uint32_t number)
{
    Projected p{number, base.first};
    const auto corners = corners_of(model, base.first);
    for (std::size_t k = 0; k < 3; ++k)
        p.at[k] = in_frame(anchor, glm::dvec3(corners[k]));
    const glm::dvec3 normal = glm::cross(p.at[1] - p.at[0], p.at[2] - p.at[0]);
    p.facing = -normal.z / std::max(glm::length(normal), 1e-300); // the frame is left-handed
    p.height = (p.at[0].z + p.at[1].z + p.at[2].z) / 3;
    p.area = glm::length(normal) / 2 * anchor.half_width_m * anchor.half_width_m;
    p.density = std::sqrt(std::abs(signed_area({base.at[0], base.at[1], base.at[2]})) / p.area);
    p.received = receives(anchor, corners) && std::ranges::any_of(p.at, [](const glm::dvec3& q) {
                     return std::abs(q.z) <= Anchor::reach;
                 });
    return p;
}

FlatTriangle flat_in_frame(const Projected& p)
{
    return {p.at[0], p.at[1], p.at[2]};
}

/// The triangles over the tile's square that face the anchor, the nearest to the viewer first.
std::vector<Projected> triangles_around(const Model& model, const BaseAtlas& base, const Places& places,
                                        const Anchor& anchor)
{
    std::vector<Projected> found;
    const glm::vec3 centre(anchor.centre), right(anchor.right), down(anchor.down), normal(anchor.normal);
    const auto half = float(anchor.half_width_m);
    const double edge = tile_reach(anchor);
    const float reach_m = half * float(edge * 1.0001), depth_m = half * float(deepest_margin * 1.0001);
    for (std::uint32_t n = 0; n < base.bounds.size(); ++n) {
        const glm::vec4& ball = base.bounds[n];
        const glm::vec3 d = glm::vec3(ball) - centre;
        if (std::abs(glm::dot(d, right)) > reach_m + ball.w ||
            std::abs(glm::dot(d, down)) > reach_m + ball.w ||
            std::abs(glm::dot(d, normal)) > depth_m + ball.w)
            continue;
        const Projected p = project(model, anchor, *places[n], n);
        const glm::dvec3 low = glm::min(glm::min(p.at[0], p.at[1]), p.at[2]),
                         high = glm::max(glm::max(p.at[0], p.at[1]), p.at[2]);
        if (p.facing > least_facing_margin && low.x < edge && high.x > -edge && low.y < edge &&
            high.y > -edge && low.z < deepest_margin && high.z > -deepest_margin)
            found.push_back(p);
    }
    std::ranges::stable_sort(found, std::ranges::greater(), &Projected::height);
    return found;
}

/// Units; 0 if no triangle can be at home in the tile.
std::uint32_t side_of_tile(std::span<const Projected> around, const Anchor& anchor)
{
    std::vector<Weighted> densities;
    for (const Projected& p : around)
        if (p.received && p.facing > least_facing_home)
            densities.push_back({p.density, p.area});
    if (densities.empty())
        return 0;
    const double units = 2 * tile_reach(anchor) * anchor.half_width_m * wound_density *
                         weighted_quantile(std::move(densities), .5);
    return std::clamp(std::uint32_t(std::ceil(std::min(units, 1e4) / wound_grain)) * wound_grain,
                      narrowest_wound, widest_wound);
}

/// A wound's tile before it has its place: coordinates start at the tile's corner. `taken`: by number.
AtlasTile wound_tile(std::span<const Projected> around, double edge, std::uint32_t side,
                     std::vector<std::uint8_t>& taken)
{
    AtlasTile tile;
    if (side == 0)
        return tile;
    const double units = side / (2 * edge), inside = edge - border / units;
    const auto placed = [&](const Projected& p) {
        AtlasTriangle triangle{p.first, {}};
        for (std::size_t k = 0; k < 3; ++k)
            triangle.at[k] = glm::vec2((glm::dvec2(p.at[k]) + edge) * units);
        return triangle;
    };
    Box2 box;
    box.add(glm::dvec2(-edge));
    box.add(glm::dvec2(edge));
    FlatLayer layer(box, around.size());
    std::vector<Weighted> densities;
    for (const Projected& p : around) {
        const bool in_tile = std::ranges::all_of(
            p.at, [&](const glm::dvec3& q) { return std::abs(q.x) <= inside && std::abs(q.y) <= inside; });
        if (in_tile && p.received && p.facing > least_facing_home && taken[p.number] == 0 &&
            layer.add(flat_in_frame(p)))
        {
            taken[p.number] = 1;
            tile.home.push_back(placed(p));
            const FlatTriangle at{tile.home.back().at[0], tile.home.back().at[1], tile.home.back().at[2]};
            densities.push_back({std::sqrt(std::abs(signed_area(at)) / p.area), p.area});
        } else {
            tile.margin.push_back(placed(p));
        }
    }
    std::ranges::reverse(tile.margin); // the nearest is drawn last
    if (tile.home.empty())
        return {};
    tile.size = glm::uvec2(side);
    tile.units_per_m = weighted_quantile(std::move(densities), .5);
    return tile;
}

/// Corners for squares with these sides (0: none), beside and below the base tiles; units. Returns the
/// atlas's height.
std::uint32_t place_squares(const Atlas& base, std::span<const std::uint32_t> sides,
                            std::vector<glm::uvec2>& corners)
{
    Horizon horizon(base.size.x / wound_grain + 1); // with the gap beyond the right edge
    for (const AtlasTile& tile : base.materials)
        for (std::uint32_t x = tile.corner.x / wound_grain; x <= (tile.corner.x + tile.size.x) / wound_grain;
             ++x)
            horizon.raise(x, (tile.corner.y + tile.size.y) / wound_grain + 1);
    std::vector<std::size_t> order(sides.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return sides[i]; });
    corners.assign(sides.size(), glm::uvec2(0));
    std::uint32_t height = base.size.y;
    for (const std::size_t i : order) {
        if (sides[i] == 0)
            break;
        const std::uint32_t cells = sides[i] / wound_grain + 1;
        const std::vector<Horizon::Span> outline(cells, {0, double(cells)});
        const auto place = horizon.put(outline);
        corners[i] = glm::uvec2(place->column, std::uint32_t(place->height)) * wound_grain;
        height = std::max(height, corners[i].y + sides[i]);
    }
    return height;
}

void move_tile(AtlasTile& tile, const glm::uvec2& corner)
{
    tile.corner = corner;
    for (auto* triangles : {&tile.home, &tile.margin})
        for (AtlasTriangle& triangle : *triangles)
            for (glm::vec2& at : triangle.at)
                at += glm::vec2(corner);
}

/// The base tiles, in which the triangles that a wound took are margins.
void add_base_tiles(Atlas& atlas, const Atlas& base, std::span<const std::uint8_t> taken)
{
    std::size_t number = 0;
    for (const AtlasTile& tile : base.materials) {
        AtlasTile& copy = atlas.materials.emplace_back(
            AtlasTile{tile.corner, tile.size, tile.units_per_m, tile.gutter, {}, {}});
        copy.home.reserve(tile.home.size());
        for (const AtlasTriangle& triangle : tile.home)
            (taken[number++] != 0 ? copy.margin : copy.home).push_back(triangle);
    }
}

} // namespace

Atlas with_wounds(const Model& model, const BaseAtlas& base, std::span<const Anchor> anchors)
{
    Places places;
    places.reserve(base.bounds.size());
    for (const AtlasTile& tile : base.atlas.materials)
        for (const AtlasTriangle& triangle : tile.home)
            places.push_back(&triangle);
    std::vector<std::vector<Projected>> around;
    std::vector<std::uint32_t> sides;
    for (const Anchor& anchor : anchors) {
        around.push_back(triangles_around(model, base, places, anchor));
        sides.push_back(side_of_tile(around.back(), anchor));
    }
    std::vector<glm::uvec2> corners;
    Atlas atlas{base.atlas.size, {}, {}, base.atlas.left_out, base.atlas.notes};
    while ((atlas.size.y = place_squares(base.atlas, sides, corners)) > most_height &&
           std::ranges::any_of(sides, [](std::uint32_t side) { return side > narrowest_wound; }))
        for (std::uint32_t& side : sides)
            side = std::max(std::min(side, narrowest_wound), side * 3 / 4 / wound_grain * wound_grain);
    std::vector<std::uint8_t> taken(base.bounds.size(), 0);
    for (std::size_t i = 0; i < anchors.size(); ++i) {
        atlas.wounds.push_back(wound_tile(around[i], tile_reach(anchors[i]), sides[i], taken));
        move_tile(atlas.wounds.back(), corners[i]);
    }
    add_base_tiles(atlas, base.atlas, taken);
    return atlas;
}

double texel_m(const Atlas& atlas, double scale)
{
    double coarsest = 0;
    for (const AtlasTile& tile : atlas.materials)
        if (tile.units_per_m > 0)
            coarsest = std::max(coarsest, 1 / (tile.units_per_m * scale));
    return coarsest;
}

} // namespace head
