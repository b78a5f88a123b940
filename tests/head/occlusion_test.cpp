// Occlusion baked at load: what it is, and that it is kept. (The rays themselves: tests/tools/bake_head_test.cpp.)
#include "head/occlusion.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <opencv2/core/utility.hpp>

#include "tests/support/temporary_folder.hpp"

namespace {

/// A square of `cells` x `cells` with corners of its own, of its own material.
void add_square(head::Model& model, const glm::vec3& middle, const glm::vec3& right, const glm::vec3& up,
                int cells, head::AlphaMode alpha)
{
    const auto first = std::uint32_t(model.vertices.size()), begin = std::uint32_t(model.indices.size());
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i)
            model.vertices.push_back({.position = middle + (2.f * float(i) / float(cells) - 1) * right +
                                                  (2.f * float(j) / float(cells) - 1) * up,
                                      .normal = glm::normalize(glm::cross(right, up)),
                                      .tangent = {1, 0, 0, 1},
                                      .uv = {}});
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const std::uint32_t a = first + std::uint32_t(j * (cells + 1) + i),
                                above = a + std::uint32_t(cells) + 1;
            model.indices.insert(model.indices.end(), {a, a + 1, above, above, a + 1, above + 1});
        }
    model.primitives.push_back(
        {begin, std::uint32_t(model.indices.size()) - begin, std::uint32_t(model.materials.size())});
    model.materials.push_back({.alpha = alpha});
    head::update_bounds(model);
}

/// A floor, a wall of the given material at its left edge, which hides half of the sky there, and hair above.
head::Model corner(head::AlphaMode wall = head::AlphaMode::Opaque)
{
    head::Model model;
    add_square(model, {0, 0, 0}, {.05f, 0, 0}, {0, 0, -.05f}, 20, head::AlphaMode::Opaque);
    add_square(model, {-.0505f, .5f, 0}, {0, 0, -.5f}, {0, .5f, 0}, 2, wall);
    add_square(model, {0, .01f, 0}, {.05f, 0, 0}, {0, 0, -.05f}, 2, head::AlphaMode::Blend);
    return model;
}

head::Model baked(head::Model model)
{
    const TemporaryFolder folder;
    EXPECT_EQ(head::bake_occlusion(model, head::Bvh(model), folder.path()), "");
    return model;
}

std::vector<float> occlusion_of(const head::Model& model)
{
    std::vector<float> values;
    for (const head::Vertex& vertex : model.vertices)
        values.push_back(vertex.occlusion);
    return values;
}

} // namespace

TEST(BakedOcclusion, IsHalfAtAWallAndOpenBehindHair)
{
    const head::Model model = baked(corner());
    for (const head::Vertex& vertex : model.vertices) {
        if (vertex.position.y > 0 || vertex.normal.y < .5f)
            continue; // of the wall
        if (vertex.position.x < -.049f) {
            EXPECT_NEAR(vertex.occlusion, .5f, .03f);
        }
        if (vertex.position.x > -.049f) {
            EXPECT_GT(vertex.occlusion, .5f); // and so not by the hair above it
        }
    }
    for (std::uint32_t i = 0; i < 9; ++i)
        EXPECT_EQ(model.vertices[model.vertices.size() - 1 - i].occlusion, 1) << "hair takes none";
}

TEST(BakedOcclusion, IsNotCastByWhatIsCutOutOrBlended)
{
    for (const head::AlphaMode alpha : {head::AlphaMode::Mask, head::AlphaMode::Blend})
        for (const float open : occlusion_of(baked(corner(alpha))))
            EXPECT_EQ(open, 1);
}

TEST(BakedOcclusion, IsTheSameOnBothSidesOfATextureSeam)
{
    head::Model model = corner();
    const auto count = std::uint32_t(model.vertices.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        model.vertices.push_back(model.vertices[i]);
        model.vertices.back().uv = {.5f, .5f};
    }
    for (std::size_t i = 0; i < model.indices.size(); i += 6) // every other triangle
        for (std::size_t k = 0; k < 3; ++k)
            model.indices[i + k] += count;
    const std::vector<float> open = occlusion_of(baked(model));
    for (std::uint32_t i = 0; i < 21 * 21; ++i)
        if (std::ranges::count(model.indices, i) > 0 && std::ranges::count(model.indices, i + count) > 0) {
            EXPECT_EQ(open[i], open[i + count]);
        }
}

TEST(BakedOcclusion, IsTheSameForAnyNumberOfThreads)
{
    const int threads = cv::getNumThreads();
    cv::setNumThreads(1);
    const std::vector<float> alone = occlusion_of(baked(corner()));
    cv::setNumThreads(7);
    EXPECT_EQ(occlusion_of(baked(corner())), alone);
    cv::setNumThreads(threads);
}

TEST(BakedOcclusion, IsKeptByTheMeshsContents)
{
    const TemporaryFolder folder;
    head::Model first = corner(), second = corner();
    EXPECT_EQ(head::bake_occlusion(first, head::Bvh(first), folder.path()), "");
    const head::Bvh empty(std::vector<glm::vec3>{}, std::vector<std::uint32_t>{});
    EXPECT_EQ(head::bake_occlusion(second, empty, folder.path()), "");
    EXPECT_EQ(occlusion_of(second), occlusion_of(first)) << "read, for this hierarchy would give 1";

    head::Model other = corner();
    other.vertices[7].position.x += 1e-4f;
    EXPECT_EQ(head::bake_occlusion(other, empty, folder.path()), "");
    EXPECT_NE(occlusion_of(other), occlusion_of(first)) << "another mesh, another file";
}

TEST(BakedOcclusion, IsMadeAnewWhenTheFileIsDamagedOrCannotBeWritten)
{
    const TemporaryFolder folder;
    head::Model first = corner();
    EXPECT_EQ(head::bake_occlusion(first, head::Bvh(first), folder.path()), "");
    const std::filesystem::path file = std::filesystem::directory_iterator(folder.path())->path();
    const auto size = std::filesystem::file_size(file);
    for (const std::string& bytes : {std::string("short"), std::string(size, '\x50')}) {
        folder.with(file.filename().string(), bytes);
        head::Model again = corner();
        EXPECT_EQ(head::bake_occlusion(again, head::Bvh(again), folder.path()), "");
        EXPECT_EQ(occlusion_of(again), occlusion_of(first));
    }
    head::Model unkept = corner();
    EXPECT_NE(head::bake_occlusion(unkept, head::Bvh(unkept), file / "no_folder"), "");
    EXPECT_EQ(occlusion_of(unkept), occlusion_of(first));
}

TEST(BakedOcclusion, IsForHeadsThatBringNoMap)
{
    head::Model model = corner();
    EXPECT_FALSE(head::has_occlusion_map(model));
    model.materials[1].occlusion = cv::Mat1b(1, 1, uchar(200));
    EXPECT_TRUE(head::has_occlusion_map(model));
    for (const float open : occlusion_of(baked(model)))
        EXPECT_EQ(open, 1);
}

namespace {

/// Two sides of a plate, 20 cm wide, and `gap` behind it, if that is not 0, a wall. The plate's front comes
/// first.
head::Model plate(float thickness, float gap = 0)
{
    head::Model model;
    add_square(model, {0, 0, 0}, {.1f, 0, 0}, {0, .1f, 0}, 20, head::AlphaMode::Opaque);
    add_square(model, {0, 0, -thickness}, {-.1f, 0, 0}, {0, .1f, 0}, 20, head::AlphaMode::Opaque);
    if (gap > 0)
        add_square(model, {0, 0, -thickness - gap}, {.1f, 0, 0}, {0, .1f, 0}, 20, head::AlphaMode::Opaque);
    return model;
}

/// In the middle of its front.
float thinness_of(const head::Model& model)
{
    return baked(model).vertices[10 * 21 + 10].thinness;
}

} // namespace

TEST(Thinness, IsThatOfASlab)
{
    for (const float thickness : {1e-3f, 2e-3f, 5e-3f})
        EXPECT_NEAR(thinness_of(plate(thickness)) * thickness, 1, .06f) << thickness;
    EXPECT_EQ(thinness_of(plate(.03f)), 0);
}

TEST(Thinness, IsLessWhenTheFarSideIsHidden)
{
    EXPECT_EQ(thinness_of(plate(2e-3f, 1e-3f)), 0);
    head::Model half = plate(2e-3f);
    // A wall that stands on the far side, at the middle.
    add_square(half, {0, -.001f, -.102f}, {.1f, 0, 0}, {0, 0, .1f}, 4, head::AlphaMode::Opaque);
    EXPECT_LT(thinness_of(half), .95f * thinness_of(plate(2e-3f)));
    EXPECT_GT(thinness_of(half), .5f * thinness_of(plate(2e-3f)));
}

TEST(Thinness, IsNoneOfWhatAnotherBodyFills)
{
    head::Model model = plate(4e-3f);
    add_square(model, {0, 0, -2e-3f}, {.1f, 0, 0}, {0, .1f, 0}, 2, head::AlphaMode::Opaque); // begins inside
    EXPECT_EQ(thinness_of(model), 0);
}

TEST(Thinness, IsKept)
{
    const TemporaryFolder folder;
    head::Model first = plate(2e-3f), second = first;
    EXPECT_EQ(head::bake_occlusion(first, head::Bvh(first), folder.path()), "");
    EXPECT_EQ(head::bake_occlusion(second, head::Bvh(std::vector<glm::vec3>{}, std::vector<std::uint32_t>{}),
                                   folder.path()),
              "");
    EXPECT_GT(first.vertices[220].thinness, 0);
    for (std::size_t i = 0; i < first.vertices.size(); ++i)
        EXPECT_EQ(first.vertices[i].thinness, second.vertices[i].thinness);
}
