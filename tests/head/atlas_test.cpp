// The skin atlas: which texture coordinates are kept, that places are unique and whole, and the wounds'
// tiles.
#include "head/atlas.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "tests/support/ray_meshes.hpp"

namespace {

using head::Atlas;
using head::AtlasTile;
using head::AtlasTriangle;
using head::BaseAtlas;
using head::Model;
using UvOf = std::function<glm::vec2(const glm::vec3& position)>;

constexpr double largest_gap = 1e-4; // of coordinates in units: float rounding

/// One opaque material of skin; each triangle with vertices of its own.
Model model_of(
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
ray_meshes::Mesh field(int cells, const std::function<double(double x, double y)>& height)
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
double flat(double, double)
{
    return 0;
}

glm::vec2 uv_of_field(const glm::vec3& p)
{
    return {5 * p.x + .5f, .5f - 5 * p.y};
}

BaseAtlas unwrapped(const Model& model)
{
    return head::unwrap(model, head::atlas_materials(model));
}

std::vector<const AtlasTile*> tiles_of(const Atlas& atlas)
{
    std::vector<const AtlasTile*> tiles;
    for (const auto* list : {&atlas.materials, &atlas.wounds})
        for (const AtlasTile& tile : *list)
            tiles.push_back(&tile);
    return tiles;
}

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

/// The texels of an image at this scale whose centres lie well inside two home triangles, or in one outside
/// of its tile.
std::size_t texels_in_conflict(const Atlas& atlas, double scale)
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
std::map<std::uint32_t, int> homes(const Atlas& atlas)
{
    std::map<std::uint32_t, int> count;
    for (const AtlasTile* tile : tiles_of(atlas))
        for (const AtlasTriangle& triangle : tile->home)
            ++count[triangle.first];
    return count;
}

void expect_one_home_each(const Model& model, const Atlas& atlas)
{
    const auto count = homes(atlas);
    EXPECT_EQ(count.size() + atlas.left_out.size(), model.indices.size() / 3);
    for (const auto& [first, homes_of_it] : count)
        EXPECT_EQ(homes_of_it, 1) << first;
}

/// Ratio of the highest to the lowest density of the triangles in a tile.
double unevenness(const Model& model, const AtlasTile& tile)
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

void expect_charted_anew(const Model& model, const char* fault)
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
head::Anchor anchor_at(double x, double y, double z, double width_m)
{
    head::Anchor anchor;
    anchor.centre = {x, y, z};
    anchor.half_width_m = width_m / 2;
    return anchor;
}

/// The place of a point of the model in the home triangles of a tile; none if it is not at home there.
std::optional<glm::dvec2> place_in(const Model& model, const AtlasTile& tile, const glm::dvec2& xy)
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

void expect_tiles_apart(const Atlas& atlas)
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

} // namespace

TEST(Atlas, KeepsGoodTextureCoordinates)
{
    const Model model = model_of(field(20, flat), uv_of_field);
    const BaseAtlas base = unwrapped(model);
    EXPECT_TRUE(base.atlas.notes.empty());
    ASSERT_EQ(base.atlas.materials.size(), 1u);
    const AtlasTile& tile = base.atlas.materials[0];
    EXPECT_EQ(tile.size, glm::uvec2(256));
    EXPECT_NEAR(tile.units_per_m, 256 / .2, 1);
    EXPECT_NEAR(head::texel_m(base.atlas, 4), .2 / 1024, 1e-6);
    for (const AtlasTriangle& triangle : tile.home)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const glm::vec2 expected = 256.f * model.vertices[model.indices[triangle.first + k]].uv;
            EXPECT_NEAR(triangle.at[k].x, expected.x, largest_gap);
            EXPECT_NEAR(triangle.at[k].y, expected.y, largest_gap);
        }
    expect_one_home_each(model, base.atlas);
    EXPECT_EQ(texels_in_conflict(base.atlas, 4), 0u);
}

TEST(Atlas, KeepsMirroredChartsThatDoNotOverlap)
{
    Model model = model_of(field(20, flat), uv_of_field);
    for (std::size_t i = 0; i < model.indices.size(); i += 3) {
        const auto corners = head::corners_of(model, i);
        if (corners[0].x + corners[1].x + corners[2].x > 0)
            for (std::size_t k = 0; k < 3; ++k) // 0.5..1 becomes 1..0.5
                model.vertices[i + k].uv.x = 1.5f - model.vertices[i + k].uv.x;
    }
    EXPECT_TRUE(unwrapped(model).atlas.notes.empty());
    const Model all_mirrored =
        model_of(field(20, flat), [](const glm::vec3& p) { return glm::vec2(.5f - 5 * p.x, .5f - 5 * p.y); });
    EXPECT_TRUE(unwrapped(all_mirrored).atlas.notes.empty());
}

TEST(Atlas, ScalesTheBoxOfTextureCoordinatesToTheTile)
{
    const Model model = model_of(field(20, flat), [](const glm::vec3& p) {
        return glm::vec2(p.x + 1.2f, .5f * p.y - .3f); // a small box outside of 0..1, of 2:1
    });
    const BaseAtlas base = unwrapped(model);
    EXPECT_TRUE(base.atlas.notes.empty());
    ASSERT_EQ(base.atlas.materials.size(), 1u);
    EXPECT_EQ(base.atlas.materials[0].size, glm::uvec2(256, 128));
}

TEST(Atlas, ChartsAnewWhereHalvesOverlap)
{
    expect_charted_anew(
        model_of(ray_meshes::sphere(), [](const glm::vec3& p) { return glm::vec2(p) * 5.f + .5f; }),
        "overlap");
}

TEST(Atlas, ChartsAnewWhereCoordinatesAreMissing)
{
    expect_charted_anew(model_of(ray_meshes::sphere()), "are missing");
}

TEST(Atlas, ChartsAnewWhereCoordinatesAreNotFinite)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect_charted_anew(model_of(field(10, flat),
                                 [&](const glm::vec3& p) {
                                     return p.x > .09f && p.y > .09f ? glm::vec2(nan) : uv_of_field(p);
                                 }),
                        "not all finite");
}

TEST(Atlas, ChartsAnewWhereCoordinatesRepeatATexture)
{
    expect_charted_anew(model_of(field(10, flat), [](const glm::vec3& p) { return 10.f * uv_of_field(p); }),
                        "range");
}

TEST(Atlas, ChartsAnewWhereAPartHasNoAreaInTheTexture)
{
    expect_charted_anew(
        model_of(field(10, flat), [](const glm::vec3& p) { return glm::vec2(std::max(p.x, -.05f), p.y); }),
        "no area");
}

TEST(Atlas, ChartsAnewWhereTheDensityDiffersWildly)
{
    expect_charted_anew(model_of(field(20, flat),
                                 [](const glm::vec3& p) {
                                     return glm::vec2(p.x < -.07f ? .002f * p.x : p.x + .07f, p.y) * 5.f;
                                 }),
                        "density");
}

TEST(Atlas, FillsMostOfTheTileWithNewCharts)
{
    for (const std::uint32_t rings : {24u, 48u, 240u}) {
        const BaseAtlas base = unwrapped(model_of(ray_meshes::sphere(rings, 2 * rings)));
        const AtlasTile& tile = base.atlas.materials.at(0);
        double area = 0;
        for (const AtlasTriangle& t : tile.home)
            area += std::abs(cross(t.at[1] - t.at[0], t.at[2] - t.at[0])) / 2;
        EXPECT_GT(area, .4 * 256 * 256) << rings;
        EXPECT_GT(tile.gutter, 1.5) << "few charts";
    }
}

TEST(Atlas, LeavesOutTrianglesWithoutArea)
{
    ray_meshes::Mesh mesh = field(4, flat);
    mesh.add({0, 0, 0}, {.01f, 0, 0}, {.02f, 0, 0});
    mesh.add({0, 0, 0}, {.01f, 0, 0}, {.02f, std::numeric_limits<float>::quiet_NaN(), 0});
    const BaseAtlas base = unwrapped(model_of(mesh, uv_of_field));
    EXPECT_EQ(base.atlas.left_out, (std::vector<std::uint32_t>{96, 99}));
    Model empty;
    empty.materials.push_back({.name = "skin"});
    EXPECT_TRUE(unwrapped(empty).atlas.materials.empty());
}

TEST(Atlas, HasOnlyOpaqueSkin)
{
    Model model = model_of(field(4, flat), uv_of_field);
    model.materials.push_back({.name = "eye"});
    model.primitives = {{0, 48, 0}, {48, 48, 1}};
    EXPECT_EQ(head::atlas_materials(model), std::vector<std::uint32_t>{0});
    model.materials[0].alpha = head::AlphaMode::Mask;
    EXPECT_TRUE(head::atlas_materials(model).empty());
    const BaseAtlas base = unwrapped(model);
    const std::array anchors{anchor_at(0, 0, 0, .04)};
    const Atlas atlas = head::with_wounds(model, base, anchors);
    EXPECT_EQ(atlas.size, glm::uvec2(0));
    ASSERT_EQ(atlas.wounds.size(), 1u);
    EXPECT_EQ(atlas.wounds[0].size, glm::uvec2(0));
}

TEST(Atlas, GivesFurtherMaterialsTheSameDensity)
{
    Model model = model_of(field(20, flat), uv_of_field);
    const auto first = std::uint32_t(model.indices.size());
    for (int i = 0; i < 600; ++i) {
        model.indices.push_back(std::uint32_t(model.vertices.size()));
        model.vertices.push_back(model.vertices[std::size_t(i)]);
        model.vertices.back().uv = {}; // charted anew
    }
    model.primitives.push_back({first, 600, 1});
    model.materials.push_back({.name = "neck"});
    const std::array<std::uint32_t, 2> both{1, 0};
    const BaseAtlas base = head::unwrap(model, both);
    ASSERT_EQ(base.atlas.materials.size(), 2u);
    EXPECT_NEAR(base.atlas.materials[1].units_per_m / base.atlas.materials[0].units_per_m, 1, .1);
    expect_tiles_apart(base.atlas);
    expect_one_home_each(model, base.atlas);
    EXPECT_EQ(texels_in_conflict(base.atlas, 4), 0u);
}

TEST(Atlas, ChartsManyRandomTrianglesInBoundedTime)
{
    const Model model = model_of(ray_meshes::soup(200'000), [](const glm::vec3& p) { return glm::vec2(p); });
    const auto start = std::chrono::steady_clock::now();
    const BaseAtlas base = unwrapped(model);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)); // about 1 s
    expect_one_home_each(model, base.atlas);
    EXPECT_EQ(base.atlas.notes.size(), 1u);
}

TEST(Atlas, ChartsEverythingThoughManyLayersLieAboveEachOther)
{
    std::vector<float> heights;
    for (int i = 0; i < 300; ++i)
        heights.push_back(1e-4f * float(i));
    const Model model = model_of(ray_meshes::squares(heights));
    const BaseAtlas base = unwrapped(model);
    expect_one_home_each(model, base.atlas);
    EXPECT_EQ(texels_in_conflict(base.atlas, 16), 0u);
}

TEST(Atlas, SplitsASpiralThatRunsAboveItself)
{
    ray_meshes::Mesh mesh;
    for (int i = 0; i < 6 * 24; ++i) { // six turns, each 2 cm above the last
        const auto at = [&](int step, double radius) {
            const double angle = 2 * std::numbers::pi * step / 24;
            return glm::vec3(radius * std::cos(angle), radius * std::sin(angle), .02 * step / 24);
        };
        mesh.add(at(i, .03), at(i, .06), at(i + 1, .06));
        mesh.add(at(i, .03), at(i + 1, .06), at(i + 1, .03));
    }
    const Model model = model_of(mesh);
    const BaseAtlas base = unwrapped(model);
    expect_one_home_each(model, base.atlas);
    EXPECT_EQ(texels_in_conflict(base.atlas, 16), 0u);
}

TEST(WoundTiles, HoldThePatchAtTwiceTheDensity)
{
    const Model model =
        model_of(field(80, [](double x, double y) { return -3 * (x * x + y * y); }), uv_of_field);
    const BaseAtlas base = unwrapped(model);
    const std::array anchors{anchor_at(.02, .01, 0, .04)};
    const Atlas atlas = head::with_wounds(model, base, anchors);
    ASSERT_EQ(atlas.wounds.size(), 1u);
    const AtlasTile& tile = atlas.wounds[0];
    EXPECT_NEAR(tile.units_per_m, 2 * base.atlas.materials[0].units_per_m, .1 * tile.units_per_m);
    for (double v = -.9; v <= .9; v += .1)
        for (double u = -.9; u <= .9; u += .1) {
            const auto place = place_in(model, tile, {.02 + .02 * u, .01 - .02 * v}); // v is down
            ASSERT_TRUE(place.has_value()) << u << " " << v;
            const glm::dvec2 expected =
                glm::dvec2(tile.corner) + (glm::dvec2(u, v) / 1.24 + 1.) * glm::dvec2(tile.size) / 2.;
            EXPECT_LT(glm::distance(*place, expected), 1e-3);
        }
    expect_one_home_each(model, atlas);
    expect_tiles_apart(atlas);
    EXPECT_EQ(texels_in_conflict(atlas, 16), 0u);
}

TEST(WoundTiles, AreSurroundedByTrianglesThatAreAtHomeElsewhere)
{
    const Model model = model_of(field(40, flat), uv_of_field);
    const BaseAtlas base = unwrapped(model);
    const std::array anchors{anchor_at(0, 0, 0, .04)};
    const Atlas atlas = head::with_wounds(model, base, anchors);
    const AtlasTile& tile = atlas.wounds[0];
    double area = 0; // of the tile, covered by home and margin
    for (const auto* list : {&tile.home, &tile.margin})
        for (const AtlasTriangle& t : *list)
            area += std::abs(cross(t.at[1] - t.at[0], t.at[2] - t.at[0])) / 2;
    EXPECT_GE(area, .999 * tile.size.x * tile.size.y);
    EXPECT_EQ(atlas.materials[0].margin.size(), tile.home.size());
    EXPECT_EQ(atlas.materials[0].home.size() + tile.home.size(), base.atlas.materials[0].home.size());
    for (const AtlasTriangle& t : tile.home)
        EXPECT_TRUE(std::ranges::any_of(atlas.materials[0].margin,
                                        [&](const auto& m) { return m.first == t.first; }));
}

TEST(WoundTiles, GiveSharedSkinToTheEarlierWound)
{
    const Model model = model_of(field(80, flat), uv_of_field);
    const std::array anchors{anchor_at(0, 0, 0, .04), anchor_at(.015, .005, 0, .04)};
    const Atlas atlas = head::with_wounds(model, unwrapped(model), anchors);
    EXPECT_TRUE(place_in(model, atlas.wounds[0], {.015, .005}));
    EXPECT_FALSE(place_in(model, atlas.wounds[1], {.0151, .0051}));
    EXPECT_TRUE(place_in(model, atlas.wounds[1], {.03, .005}));
    expect_one_home_each(model, atlas);
    EXPECT_EQ(texels_in_conflict(atlas, 16), 0u);
    std::size_t shared = 0; // the second tile shows also what is at home in the first
    for (const AtlasTriangle& m : atlas.wounds[1].margin)
        shared +=
            std::ranges::any_of(atlas.wounds[0].home, [&](const auto& t) { return t.first == m.first; });
    EXPECT_GT(shared, 100u);
}

TEST(WoundTiles, LeaveWhatLiesUnderACreaseInTheBaseTile)
{
    // A fold: the skin runs back under itself by 1 cm, 5 mm lower, and on from there.
    ray_meshes::Mesh mesh;
    const auto strip = [&](const glm::dvec2& from, const glm::dvec2& to) { // (x, z)
        for (int j = 0; j < 80; ++j)
            for (int i = 0; i < 20; ++i) {
                const auto at = [&](int m, int n) {
                    const glm::dvec2 q = from + (to - from) * (m / 20.);
                    return glm::vec3(q.x, .2 * n / 80 - .1, q.y);
                };
                mesh.add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
                mesh.add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
            }
    };
    strip({-.05, 0}, {.005, 0});
    strip({.005, 0}, {-.005, -.0025});
    strip({-.005, -.005}, {.05, -.005});
    const Model model = model_of(mesh);
    const std::array anchors{anchor_at(0, 0, 0, .04)};
    const Atlas atlas = head::with_wounds(model, unwrapped(model), anchors);
    expect_one_home_each(model, atlas);
    EXPECT_EQ(texels_in_conflict(atlas, 16), 0u);
    int low_and_hidden = 0, low_and_seen = 0;
    for (const AtlasTriangle& t : atlas.wounds[0].home) {
        const auto c = head::corners_of(model, t.first);
        const float right = std::max({c[0].x, c[1].x, c[2].x});
        low_and_hidden += c[0].z < -.004f && right < .0049f;
        low_and_seen += c[0].z < -.004f && right > .009f;
    }
    EXPECT_EQ(low_and_hidden, 0);
    EXPECT_GT(low_and_seen, 100);
    float last = -1e9f; // margins: far to near
    for (const AtlasTriangle& t : atlas.wounds[0].margin) {
        const auto c = head::corners_of(model, t.first);
        EXPECT_GE((c[0].z + c[1].z + c[2].z) / 3, last - 1e-6f);
        last = (c[0].z + c[1].z + c[2].z) / 3;
    }
}

TEST(WoundTiles, SixtyFourSmallOnesFit)
{
    const Model model = model_of(field(200, flat), uv_of_field);
    std::vector<head::Anchor> anchors;
    for (int i = 0; i < 64; ++i)
        anchors.push_back(anchor_at(.02 * (i % 8) - .07, .02 * int(i / 8) - .07, 0, .006));
    const Atlas atlas = head::with_wounds(model, unwrapped(model), anchors);
    ASSERT_EQ(atlas.wounds.size(), 64u);
    EXPECT_EQ(atlas.size.x, 256u);
    EXPECT_LE(atlas.size.y, 512u);
    expect_tiles_apart(atlas);
    expect_one_home_each(model, atlas);
    for (const AtlasTile& tile : atlas.wounds)
        EXPECT_GT(tile.home.size(), 10u);
}

TEST(WoundTiles, BecomeCoarserWhereTheyNeedTooMuchSpace)
{
    const Model model = model_of(field(40, flat), uv_of_field);
    const std::vector<head::Anchor> anchors(64, anchor_at(0, 0, 0, .1));
    std::vector<head::Anchor> apart = anchors;
    for (std::size_t i = 0; i < apart.size(); ++i)
        apart[i].centre.x = .003 * double(i) - .1;
    const Atlas atlas = head::with_wounds(model, unwrapped(model), apart);
    EXPECT_LE(atlas.size.y, 1024u);
    expect_tiles_apart(atlas);
    expect_one_home_each(model, atlas);
}

TEST(WoundTiles, AwayFromTheSkinAreEmpty)
{
    const Model model = model_of(field(10, flat), uv_of_field);
    const BaseAtlas base = unwrapped(model);
    const std::array anchors{anchor_at(3, 0, 0, .04)};
    const Atlas atlas = head::with_wounds(model, base, anchors);
    EXPECT_EQ(atlas.wounds.at(0).size, glm::uvec2(0));
    EXPECT_EQ(atlas.size, base.atlas.size);
    expect_one_home_each(model, atlas);
}
