// The order of triangles and vertices in which a head is drawn.
#include <algorithm>
#include <array>
#include <deque>
#include <gtest/gtest.h>
#include <random>

#include "head/model.hpp"

namespace {

using head::Model;

/// Vertices that a cache of the last 16 of them fetches.
std::size_t fetches(const std::vector<std::uint32_t>& indices)
{
    std::deque<std::uint32_t> cache;
    std::size_t count = 0;
    for (const std::uint32_t index : indices) {
        if (std::ranges::find(cache, index) != cache.end())
            continue;
        ++count;
        cache.push_front(index);
        cache.resize(std::min<std::size_t>(cache.size(), 16));
    }
    return count;
}

/// The corners' positions of the primitive's triangles.
std::vector<std::array<std::array<float, 2>, 3>> triangles_of(const Model& model,
                                                              const head::Primitive& primitive)
{
    std::vector<std::array<std::array<float, 2>, 3>> triangles;
    for (std::uint32_t i = 0; i < primitive.index_count; i += 3) {
        auto& triangle = triangles.emplace_back();
        for (std::size_t c = 0; const glm::vec3& corner : corners_of(model, primitive.first_index + i))
            triangle[c++] = {corner.x, corner.y};
    }
    return triangles;
}

TEST(DrawingOrder, FetchesEachVertexAboutOnceAndKeepsEveryTriangle)
{
    constexpr std::uint32_t cells = 24;
    Model model;
    for (std::uint32_t j = 0; j <= cells; ++j)
        for (std::uint32_t i = 0; i <= cells; ++i)
            model.vertices.push_back({{i, j, 0}, {0, 0, 1}, {1, 0, 0, 1}, {0, 0}});
    std::vector<std::array<std::uint32_t, 3>> grid;
    for (std::uint32_t a = 0; a < cells * (cells + 1); ++a)
        if (const std::uint32_t below = a + cells + 1; a % (cells + 1) != cells) {
            grid.push_back({a, a + 1, below});
            grid.push_back({a + 1, below + 1, below});
        }
    for (std::uint32_t material : {0, 1}) { // the same triangles, opaque and blended
        std::ranges::shuffle(grid, std::mt19937(7 + material));
        model.primitives.push_back(
            {std::uint32_t(model.indices.size()), std::uint32_t(3 * grid.size()), material});
        for (const auto& triangle : grid)
            model.indices.insert(model.indices.end(), triangle.begin(), triangle.end());
    }
    model.materials.resize(2);
    model.materials[1].alpha = head::AlphaMode::Blend;
    auto opaque = triangles_of(model, model.primitives[0]);
    const auto blended = triangles_of(model, model.primitives[1]);
    const auto opaque_fetches = [&] {
        return double(fetches(
                   {model.indices.begin(), model.indices.begin() + model.primitives[0].index_count})) /
               double(model.vertices.size());
    };
    EXPECT_GT(opaque_fetches(), 4);

    head::order_for_drawing(model);
    EXPECT_LT(opaque_fetches(), 1.6);
    auto ordered = triangles_of(model, model.primitives[0]);
    EXPECT_NE(ordered, opaque);
    std::ranges::sort(ordered);
    std::ranges::sort(opaque);
    EXPECT_EQ(ordered, opaque);
    EXPECT_EQ(triangles_of(model, model.primitives[1]), blended)
        << "blended triangles cover each other in their order";
    std::uint32_t seen = 0; // vertices are numbered in the order of their first use
    for (const std::uint32_t index : model.indices) {
        EXPECT_LE(index, seen);
        seen = std::max(seen, index + 1);
    }
    EXPECT_EQ(seen, model.vertices.size());
}

} // namespace
