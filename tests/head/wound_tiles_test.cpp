// The wounds' tiles of the skin atlas.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "atlas_layouts.hpp"

using namespace atlas_layouts;

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
    EXPECT_LE(atlas.size.y, 1024u); // with room for the surroundings of each
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
