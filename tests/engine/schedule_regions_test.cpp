// The schedule's regions: what of an image is written again when only some of its inputs have changed. No
// device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/graph/pass_work.hpp"
#include "scheduled_passes.hpp"

using namespace scheduled_passes;

/// wound -> forward, which confines the wound's changes to `region` -> tonemap in place -> readback.
struct Spot
{
    Spot(float day, const graph::Region& region, float light = 1)
    {
        const graph::ImageId wound = add_compute(graph, "warp", {}, day);
        const graph::ImageId lit = add_raster(graph, "forward", {wound});
        auto& forward = std::get<graph::RasterPass>(graph.passes.back());
        forward.uniform("light", light);
        forward.confine(wound, region);
        const graph::ImageId shown = add_compute(graph, "tonemap", {lit});
        std::get<graph::ComputePass>(graph.passes.back()).in_place(lit);
        graph.readback("picture", shown);
    }
    graph::Graph graph;
};

constexpr graph::Region spot{8, 4, 16, 8}, moved_spot{20, 6, 10, 10};

TEST(Schedule, AConfinedChangeRefreshesItsRegionInEveryPassThatFollowsInPlace)
{
    const graph::Plan first = graph::schedule(Spot(3, spot).graph, {});
    EXPECT_EQ(pass_plan(first, "forward").region, std::nullopt) << "nothing to keep yet";
    const graph::Plan second = graph::schedule(Spot(4, spot).graph, first.memory);
    EXPECT_EQ(pass_plan(second, "warp").region, std::nullopt);
    EXPECT_EQ(pass_plan(second, "forward").region, spot);
    EXPECT_EQ(pass_plan(second, "tonemap").region, spot);
    EXPECT_NEAR(graph::refreshed_share(Spot(4, spot).graph, pass_plan(second, "tonemap")), 16 * 8 / 2048.,
                1e-12);
    const graph::Barrier target_barrier = pass_plan(second, "forward").barriers.back().barrier;
    EXPECT_EQ(target_barrier.old_layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) << "the contents are kept";
    EXPECT_EQ(trace(graph::schedule(Spot(4, spot).graph, second.memory)),
              "warp skipped: unchanged | forward skipped: unchanged | tonemap skipped: unchanged");
}

/// light, which confines the wound's changes to `inside` -> forward, which shows a change within `source` at
/// `region`.
graph::Graph on_a_surface(float day, const graph::Region& inside, const graph::Region& source,
                          const graph::Region& region)
{
    graph::Graph graph;
    const graph::ImageId wound = add_compute(graph, "warp", {}, day);
    const graph::ImageId light = add_raster(graph, "light", {wound});
    std::get<graph::RasterPass>(graph.passes.back()).confine(wound, inside);
    const graph::ImageId picture = add_raster(graph, "forward", {light});
    std::get<graph::RasterPass>(graph.passes.back()).confine(light, source, region);
    graph.readback("picture", picture);
    return graph;
}

TEST(Schedule, AChangeWithinASourceRefreshesWhereItIsShown)
{
    constexpr graph::Region tile{0, 0, 32, 16};
    graph::Memory memory = graph::schedule(on_a_surface(3, spot, tile, moved_spot), {}).memory;
    const graph::Plan plan = graph::schedule(on_a_surface(4, spot, tile, moved_spot), memory);
    EXPECT_EQ(pass_plan(plan, "light").region, spot);
    EXPECT_EQ(pass_plan(plan, "forward").region, moved_spot);
}

TEST(Schedule, AChangeBeyondASourceRefreshesEverything)
{
    constexpr graph::Region tile{0, 0, 12, 16};
    graph::Memory memory = graph::schedule(on_a_surface(3, spot, tile, moved_spot), {}).memory;
    EXPECT_EQ(pass_plan(graph::schedule(on_a_surface(4, spot, tile, moved_spot), memory), "forward").region,
              std::nullopt);
    constexpr graph::Region all{0, 0, 64, 32};
    memory = graph::schedule(on_a_surface(3, all, tile, moved_spot), {}).memory;
    EXPECT_EQ(pass_plan(graph::schedule(on_a_surface(4, all, tile, moved_spot), memory), "forward").region,
              std::nullopt);
}

TEST(Schedule, ARegionThatMovesRefreshesWhereItWasToo)
{
    graph::Memory memory = graph::schedule(Spot(3, spot).graph, {}).memory;
    const graph::Plan plan = graph::schedule(Spot(4, moved_spot).graph, memory);
    EXPECT_EQ(pass_plan(plan, "forward").region, graph::bounds(spot, moved_spot));
}

TEST(Schedule, WhereAnInputThatStandsWasDrawnIsNotForgotten)
{
    graph::Memory memory = graph::schedule(Spot(3, spot).graph, {}).memory;
    memory = graph::schedule(Spot(3, moved_spot).graph, memory).memory; // nothing runs
    EXPECT_EQ(pass_plan(graph::schedule(Spot(4, moved_spot).graph, memory), "forward").region,
              graph::bounds(spot, moved_spot));
}

TEST(Schedule, AChangeThatIsNotConfinedRefreshesEverything)
{
    graph::Memory memory = graph::schedule(Spot(3, spot).graph, {}).memory;
    const graph::Plan plan = graph::schedule(Spot(4, spot, 2).graph, memory);
    EXPECT_EQ(pass_plan(plan, "forward").region, std::nullopt);
    EXPECT_EQ(pass_plan(plan, "tonemap").region, std::nullopt);
    EXPECT_EQ(graph::refreshed_share(Spot(4, spot, 2).graph, pass_plan(plan, "tonemap")), 1);
}

TEST(Schedule, AnImageWhoseContentsWereLostIsWrittenWhole)
{
    graph::Memory memory = graph::schedule(Spot(3, spot).graph, {}).memory;
    memory.images.at("forward_out").content_version = 0;
    EXPECT_EQ(pass_plan(graph::schedule(Spot(4, spot).graph, memory), "forward").region, std::nullopt);
}

TEST(Schedule, AReaderThatMissedARefreshIsWrittenWhole)
{
    const auto frame = [](float day, bool shown) {
        graph::Graph graph = Spot(day, spot).graph;
        if (!shown)
            graph.readbacks.clear(); // tonemap is culled
        graph.readback("light", graph::ImageId{1});
        return graph;
    };
    const graph::Memory memory = graph::schedule(frame(3, true), {}).memory;
    const graph::Plan second = graph::schedule(frame(4, false), memory);
    ASSERT_EQ(pass_plan(second, "tonemap").state, graph::PassState::Culled);
    EXPECT_EQ(pass_plan(second, "forward").region, spot);
    const graph::Plan third = graph::schedule(frame(5, true), second.memory);
    EXPECT_EQ(pass_plan(third, "forward").region, spot);
    EXPECT_EQ(pass_plan(third, "tonemap").region, std::nullopt)
        << "two refreshes have passed since its last run";
}

TEST(Schedule, AnInputThatReachesNoTexelRunsNothing)
{
    graph::Memory memory = graph::schedule(Spot(3, {}).graph, {}).memory;
    const graph::Plan second = graph::schedule(Spot(4, {}).graph, memory);
    EXPECT_EQ(trace(second),
              "warp ran: changed: uniform value | forward skipped: unaffected: changed: input warp_out "
              "| tonemap skipped: unaffected: changed: input forward_out");
    EXPECT_EQ(pass_plan(graph::schedule(Spot(5, spot).graph, second.memory), "forward").region, spot)
        << "its picture counts as one of day 4";
}
