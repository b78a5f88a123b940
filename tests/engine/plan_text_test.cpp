// The schedule as text and as a Graphviz graph. No device.
#include "engine/graph/plan_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

graph::Graph small_graph()
{
    graph::Graph graph;
    const graph::ImageDesc desc{64, 32, VK_FORMAT_R16G16B16A16_SFLOAT};
    const graph::ImageId albedo = graph.import("albedo", graph::ExternalImage{desc, VK_NULL_HANDLE, 1});
    const graph::ImageId table = graph.image("table", desc), picture = graph.image("picture", desc);
    const graph::ImageId unused = graph.image("unused", desc);
    graph::ComputePass& lut = graph.compute("lut", "lut.comp");
    lut.store("table", table);
    lut.dispatch(64, 32);
    graph::ComputePass& idle = graph.compute("idle", "idle.comp");
    idle.store("out", unused);
    idle.dispatch(64, 32);
    graph::RasterPass& forward = graph.raster("forward");
    forward.color(picture, {});
    forward.sample("table", table);
    forward.sample("albedo", albedo);
    forward.draw("forward").index_count = 3;
    forward.every_frame();
    graph.readback("picture", picture);
    return graph;
}

TEST(PlanText, NamesPassesImagesBarriersAndReasons)
{
    const graph::Graph graph = small_graph();
    const graph::Plan first = graph::schedule(graph, {});
    const std::string text = graph::plan_text(graph, first);
    EXPECT_THAT(text,
                AllOf(HasSubstr("lut                      ran      first run"),
                      HasSubstr("idle                     culled   unused: nothing samples unused"),
                      HasSubstr("reads    table, albedo"), HasSubstr("writes   picture"),
                      HasSubstr("barrier  table: compute -> vertex+fragment, general -> shader read"),
                      HasSubstr("at the end: barrier  picture: colour output -> copy"),
                      HasSubstr("64 x 32 RGBA16F"), HasSubstr("from lut to forward"), HasSubstr("imported")));
    EXPECT_THAT(graph::plan_text(graph, graph::schedule(graph, first.memory)),
                HasSubstr("lut                      skipped  unchanged"));
}

TEST(PlanText, DrawsAGraphvizGraphWithAnEdgeForEveryAccess)
{
    const graph::Graph graph = small_graph();
    const std::string dot = graph::plan_dot(graph, graph::schedule(graph, {}));
    EXPECT_THAT(
        dot, AllOf(HasSubstr("digraph frame {"), HasSubstr("\"pass lut\" -> \"image table\" [label=barrier]"),
                   HasSubstr("\"image table\" -> \"pass forward\" [label=barrier]"),
                   HasSubstr("\"image albedo\" -> \"pass forward\";"),
                   HasSubstr("\"image picture\" -> \"readback picture\""), HasSubstr("style=dotted")));
    EXPECT_EQ(std::count(dot.begin(), dot.end(), '{'), std::count(dot.begin(), dot.end(), '}'));
}

TEST(PlanText, NamesCannotBreakOutOfTheGraphvizText)
{
    graph::Graph graph;
    graph.readback("x", graph.image("a\"b\\", {8, 8, VK_FORMAT_R8G8B8A8_UNORM}));
    graph::ComputePass& pass = graph.compute("p", "p.comp");
    pass.store("out", graph::ImageId{0});
    pass.dispatch(1, 1);
    EXPECT_THAT(graph::plan_dot(graph, graph::schedule(graph, {})), HasSubstr("\"image a\\\"b\\\\\""));
}

} // namespace
