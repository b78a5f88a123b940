// The table of accesses and the barriers that follow from it. No device.
#include "engine/graph/access.hpp"

#include <gtest/gtest.h>

namespace {

constexpr VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 raster =
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 color = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;

TEST(AccessTable, HasARowForEveryUsageAndOnlyWritersHaveWriteAccess)
{
    constexpr VkAccessFlags2 writes =
        VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
    for (int i = 0; i <= static_cast<int>(graph::Usage::HostRead); ++i) {
        const graph::AccessRow& row = graph::access_row(static_cast<graph::Usage>(i));
        EXPECT_EQ(row.usage, static_cast<graph::Usage>(i));
        EXPECT_NE(row.stages, 0u) << row.name;
        EXPECT_EQ((row.access & writes) != 0, row.writes) << row.name;
    }
}

TEST(Barriers, TheFirstWriteOnlyTakesTheImageOutOfTheUndefinedLayout)
{
    graph::AccessState state;
    const auto barrier = graph::advance(state, graph::Usage::Stored);
    ASSERT_TRUE(barrier);
    EXPECT_EQ(*barrier, (graph::Barrier{.dst_stages = compute,
                                        .dst_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                        .new_layout = VK_IMAGE_LAYOUT_GENERAL}));
}

TEST(Barriers, ReadAfterWriteFlushesTheWriteForTheReader)
{
    graph::AccessState state;
    graph::advance(state, graph::Usage::Stored);
    const auto barrier = graph::advance(state, graph::Usage::SampledInRaster);
    ASSERT_TRUE(barrier);
    EXPECT_EQ(*barrier, (graph::Barrier{.src_stages = compute,
                                        .src_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                        .dst_stages = raster,
                                        .dst_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                        .old_layout = VK_IMAGE_LAYOUT_GENERAL,
                                        .new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}));
}

TEST(Barriers, ASecondReadOfTheSameKindNeedsNoBarrier)
{
    graph::AccessState state;
    graph::advance(state, graph::Usage::Color);
    graph::advance(state, graph::Usage::SampledInCompute);
    EXPECT_FALSE(graph::advance(state, graph::Usage::SampledInCompute));
}

TEST(Barriers, AReaderInAnotherStageIsMadeToSeeTheWriteWithoutAChangeOfLayout)
{
    graph::AccessState state;
    graph::advance(state, graph::Usage::Color);
    graph::advance(state, graph::Usage::SampledInCompute);
    const auto barrier = graph::advance(state, graph::Usage::SampledInRaster);
    ASSERT_TRUE(barrier);
    EXPECT_EQ(barrier->src_stages, compute) << "chained to the barrier that changed the layout";
    EXPECT_EQ(barrier->dst_stages, raster);
    EXPECT_EQ(barrier->old_layout, barrier->new_layout);
    EXPECT_FALSE(graph::advance(state, graph::Usage::SampledInRaster));
    EXPECT_FALSE(graph::advance(state, graph::Usage::SampledInCompute)) << "the first reader still sees it";
}

TEST(Barriers, WriteAfterReadWaitsForAllReadersAndFlushesNothing)
{
    graph::AccessState state;
    graph::advance(state, graph::Usage::Stored);
    graph::advance(state, graph::Usage::SampledInCompute);
    graph::advance(state, graph::Usage::SampledInRaster);
    const auto barrier = graph::advance(state, graph::Usage::Stored);
    ASSERT_TRUE(barrier);
    EXPECT_EQ(barrier->src_stages, compute | raster);
    EXPECT_EQ(barrier->src_access, 0u);
    EXPECT_EQ(barrier->old_layout, VK_IMAGE_LAYOUT_UNDEFINED) << "a writer replaces the contents";
}

TEST(Barriers, WriteAfterWriteFlushesTheFirstWrite)
{
    graph::AccessState state;
    graph::advance(state, graph::Usage::Color);
    const auto barrier = graph::advance(state, graph::Usage::Color);
    ASSERT_TRUE(barrier);
    EXPECT_EQ(barrier->src_stages, color);
    EXPECT_EQ(barrier->src_access, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
    EXPECT_EQ(barrier->dst_stages, color);
}

TEST(Barriers, AChangeOfLayoutBetweenReadersWaitsForTheReaders)
{
    graph::AccessState state;
    graph::advance(state, graph::Usage::Color);
    graph::advance(state, graph::Usage::SampledInRaster);
    const auto barrier = graph::advance(state, graph::Usage::CopySource);
    ASSERT_TRUE(barrier);
    EXPECT_EQ(barrier->src_stages, raster);
    EXPECT_EQ(barrier->src_access, 0u);
    EXPECT_EQ(barrier->new_layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    // back to a sampled layout
    const auto back = graph::advance(state, graph::Usage::SampledInCompute);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->src_stages, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
    EXPECT_EQ(back->old_layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
}

} // namespace
