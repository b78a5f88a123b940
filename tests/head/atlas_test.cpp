// The skin atlas: which texture coordinates are kept, and that places are unique and whole.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include "atlas_layouts.hpp"

using namespace atlas_layouts;

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
