// The skin's surface on its atlas: what lies beyond the borders of charts.
#include <gtest/gtest.h>

#include "atlas_layouts.hpp"
#include "head/atlas_surface.hpp"

using namespace atlas_layouts;

namespace {

/// A flat field of 20 cm whose right half is a chart of its own: turned, and of half the size.
Model halved_field()
{
    Model model = model_of(field(20, flat), uv_of_field);
    for (std::size_t i = 0; i < model.indices.size(); i += 3) {
        const auto corners = head::corners_of(model, i);
        const bool right = corners[0].x + corners[1].x + corners[2].x > 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& p = model.vertices[i + k].position;
            model.vertices[i + k].uv = right ? glm::vec2(.6f + 2 * (p.y + .1f), .9f - 2 * p.x)
                                             : glm::vec2(5 * (p.x + .1f), 5 * (p.y + .1f));
        }
    }
    return model;
}

/// Where on the field a place of the atlas of halved_field() is.
glm::vec2 on_field(const AtlasTile& tile, const glm::vec2& at, bool right)
{
    const glm::vec2 uv = glm::vec2(at) / float(tile.size.x);
    return right ? glm::vec2((.9f - uv.y) / 2, (uv.x - .6f) / 2 - .1f) : uv / 5.f - .1f;
}

} // namespace

TEST(AtlasSurface, ContinuesAcrossASeamWithTheTriangleThere)
{
    const Model model = halved_field();
    const BaseAtlas base = unwrapped(model);
    ASSERT_TRUE(base.atlas.notes.empty());
    ASSERT_EQ(base.atlas.materials[0].size, glm::uvec2(256));
    const AtlasTile& tile = base.atlas.materials[0];
    const head::AtlasSurface surface = head::surface_of(model, base.atlas.materials, true);
    ASSERT_EQ(surface.pieces.size(), 1u);
    const head::SurfacePiece& piece = surface.pieces[0];
    EXPECT_EQ(piece.triangles, model.indices.size());
    constexpr float width = 3; // units
    int seams = 0, free_borders = 0;
    for (std::uint32_t i = 0; i < piece.skirts; ++i) {
        const head::SurfaceVertex& v = surface.vertices[surface.indices[piece.first_index + i]];
        if (v.at_outward == glm::vec2(0) || std::abs(v.position.y) > .095f)
            continue; // at a corner a skirt is mitred
        const glm::vec3 position = v.position + width * v.position_outward;
        const glm::vec2 from = v.from + width * v.from_outward;
        EXPECT_NEAR(position.z, 0, 1e-6);
        if (std::abs(v.position.x) > 1e-4f) { // the field's outline
            ++free_borders;
            EXPECT_EQ(v.from, v.at);
            EXPECT_EQ(v.from_outward, glm::vec2(0));
            EXPECT_GT(std::abs(position.x), .1f);
            continue;
        }
        ++seams;
        const bool to_right = v.at.x < 150; // a skirt of the left half
        EXPECT_EQ(position.x > 0, to_right);
        const glm::vec2 expected = on_field(tile, from, to_right);
        EXPECT_NEAR(position.x, expected.x, 1e-5);
        EXPECT_NEAR(position.y, expected.y, 1e-5);
        // The chart is continued at its own density, 5 units of uv per metre or 2.
        EXPECT_NEAR(std::abs(position.x), width / 256 / (to_right ? 5 : 2), 1e-5);
    }
    EXPECT_EQ(seams, 2 * 3 * 19); // 19 places are not at a corner; each is three indices of outer vertices
    EXPECT_GT(free_borders, 0);
}

TEST(AtlasSurface, HasNoSkirtWhereTrianglesJoinOnTheAtlas)
{
    const Model model = model_of(field(20, flat), uv_of_field);
    const BaseAtlas base = unwrapped(model);
    const head::AtlasSurface surface = head::surface_of(model, base.atlas.materials, true);
    EXPECT_EQ(surface.pieces[0].skirts, 4u * 20 * 6);
    EXPECT_EQ(head::surface_of(model, base.atlas.materials, false).pieces[0].skirts, 0u);
}

TEST(AtlasSurface, SurvivesTrianglesWithoutArea)
{
    Model model = halved_field();
    for (std::size_t k = 0; k < 3; ++k)
        model.vertices[k].uv = {.25f, .25f};
    for (const glm::vec3& p : {glm::vec3(0), glm::vec3(.1f, 0, 0)})
        for (std::size_t k = 3; k < 6; ++k)
            model.vertices[k].position = p;
    const BaseAtlas base = head::unwrap(model, head::atlas_materials(model));
    for (const head::SurfaceVertex& v : head::surface_of(model, base.atlas.materials, true).vertices)
        for (const float value : {v.at_outward.x, v.at_outward.y, v.from_outward.x, v.from_outward.y,
                                  v.position_outward.x, v.position_outward.y, v.position_outward.z})
            EXPECT_TRUE(std::isfinite(value));
}
