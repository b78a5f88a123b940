// Mistakes in a declaration: all are found and named, with pass and image. No device.
#include "engine/graph/schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using testing::HasSubstr;

constexpr graph::ImageDesc target{64, 32, VK_FORMAT_R16G16B16A16_SFLOAT};
constexpr graph::ImageDesc depth_target{64, 32, VK_FORMAT_D32_SFLOAT};

std::string mistakes(const graph::Graph& graph)
{
    try {
        (void)graph::schedule(graph, {});
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "none";
}

TEST(GraphCheck, NamesEveryMistakeAtOnce)
{
    graph::Graph graph;
    const graph::ImageId orphan = graph.image("orphan", target);
    const graph::ImageId texture = graph.import("albedo", graph::ExternalImage{target, VK_NULL_HANDLE, 1});
    graph::ComputePass& own = graph.compute("own", "own.comp");
    own.sample("input", orphan);
    own.store("output", texture);
    own.dispatch(0, 8);
    graph.readback("picture", orphan);
    const std::string text = mistakes(graph);
    EXPECT_THAT(text, HasSubstr("pass own: samples orphan, which no pass writes"));
    EXPECT_THAT(text, HasSubstr("pass own: writes albedo, which is imported"));
    EXPECT_THAT(text, HasSubstr("pass own: dispatches 0 x 8 invocations"));
    EXPECT_THAT(text, HasSubstr("readback picture: uses orphan, which no pass writes"));
}

TEST(GraphCheck, FindsWritersOnACycle)
{
    graph::Graph graph;
    const graph::ImageId a = graph.image("a_image", target), b = graph.image("b_image", target);
    for (const auto& [name, from, to] : {std::tuple{"a", b, a}, std::tuple{"b", a, b}}) {
        graph::ComputePass& pass = graph.compute(name, "x.comp");
        pass.sample("input", from);
        pass.store("output", to);
        pass.dispatch(1, 1);
    }
    EXPECT_THAT(mistakes(graph),
                HasSubstr("pass a: no order is possible, these passes need each other's images: a, b"));
}

TEST(GraphCheck, RefusesSamplingWhatThePassItselfWrites)
{
    graph::Graph graph;
    const graph::ImageId image = graph.image("image", target);
    graph::ComputePass& pass = graph.compute("pass", "x.comp");
    pass.sample("input", image);
    pass.store("output", image);
    pass.dispatch(1, 1);
    EXPECT_THAT(mistakes(graph), HasSubstr("pass pass: samples image, which it also writes"));
}

TEST(GraphCheck, RefusesTargetsOfTwoSizesOrSampleCounts)
{
    graph::Graph graph;
    graph::RasterPass& pass = graph.raster("forward");
    pass.color(graph.image("color", target), {});
    pass.depth(graph.image("depth", {64, 64, VK_FORMAT_D32_SFLOAT, 4}));
    pass.draw("forward").index_count = 3;
    const std::string text = mistakes(graph);
    EXPECT_THAT(text, HasSubstr("pass forward: depth is 64 x 64, its other targets are 64 x 32"));
    EXPECT_THAT(text, HasSubstr("pass forward: depth has 4 samples, its other targets have 1"));
}

TEST(GraphCheck, RefusesWrongResolves)
{
    graph::Graph graph;
    graph::RasterPass& pass = graph.raster("forward");
    pass.color(graph.image("single", target), {}, graph.image("resolved", {8, 8, VK_FORMAT_R8G8B8A8_UNORM}));
    pass.draw("forward").index_count = 3;
    const std::string text = mistakes(graph);
    EXPECT_THAT(text, HasSubstr("pass forward: single is resolved but not multisampled"));
    EXPECT_THAT(text, HasSubstr("pass forward: resolved cannot take the resolve of single"));
}

TEST(GraphCheck, RefusesDoubleNamesWritersAndReadbacks)
{
    graph::Graph graph;
    const graph::ImageId image = graph.image("image", target);
    graph.image("image", target);
    for (int i = 0; i < 2; ++i) {
        graph::ComputePass& pass = graph.compute("pass", "x.comp");
        pass.store("output", image);
        pass.dispatch(1, 1);
        graph.readback("picture", image);
    }
    const std::string text = mistakes(graph);
    EXPECT_THAT(text, HasSubstr("image image: declared twice"));
    EXPECT_THAT(text, HasSubstr("pass pass: declared twice"));
    EXPECT_THAT(text, HasSubstr("pass pass: writes image, which pass pass writes too"));
    EXPECT_THAT(text, HasSubstr("readback picture: declared twice"));
}

TEST(GraphCheck, RefusesRegionsOfWhatAPassDoesNotReadOrThatItsImagesDoNotHold)
{
    graph::Graph graph;
    const graph::ImageId small = graph.image("small", {8, 8, target.format}), large = graph.image("large", target);
    graph::ComputePass& pass = graph.compute("pass", "x.comp");
    pass.uniform("Block", 1.0f);
    pass.store("small", small);
    pass.store("large", large);
    pass.dispatch(8, 8);
    pass.confine("Block", {0, 0, 9, 8});
    pass.confine("Blok", {0, 0, 1, 1});
    pass.confine("Blok", {0, 0, 2, 2});
    pass.in_place(graph.import("albedo", graph::ExternalImage{target, VK_NULL_HANDLE, 1}));
    const graph::ImageId wide = graph.import("wide", graph::ExternalImage{{64, 8, target.format}, VK_NULL_HANDLE, 2});
    graph::ComputePass& second = graph.compute("second", "x.comp");
    second.sample("input", wide);
    second.store("output", graph.image("narrow", {8, 8, target.format}));
    second.dispatch(8, 8);
    second.in_place(wide);
    const std::string text = mistakes(graph);
    EXPECT_THAT(text, HasSubstr("pass pass: confines changes of Blok twice"));
    EXPECT_THAT(text, HasSubstr("pass second: works in place on wide, which is not of its images' size"));
    EXPECT_THAT(text, HasSubstr("pass pass: confines a change to a region, but writes images of several sizes"));
    EXPECT_THAT(text, HasSubstr("pass pass: confines changes of Block to a region beyond its images"));
    EXPECT_THAT(text, HasSubstr("pass pass: confines changes of Blok, which it does not read"));
    EXPECT_THAT(text, HasSubstr("pass pass: confines changes of albedo, which it does not read"));
}

TEST(GraphCheck, RefusesToFilterDepth)
{
    graph::Graph graph;
    const graph::ImageId depth =
        graph.import("shadow", graph::ExternalImage{depth_target, VK_NULL_HANDLE, 1});
    graph::ComputePass& pass = graph.compute("pass", "x.comp");
    pass.sample("shadow", depth, graph::Sampler::LinearClamp);
    pass.store("output", graph.image("image", target));
    pass.dispatch(1, 1);
    EXPECT_THAT(mistakes(graph), HasSubstr("pass pass: samples shadow with a filter"));
}

TEST(GraphCheck, RefusesImpossibleImagesAndPasses)
{
    graph::Graph graph;
    graph.image("flat", {0, 8, VK_FORMAT_R8G8B8A8_UNORM});
    graph.image("odd", {8, 8, VK_FORMAT_R8G8B8A8_UNORM, 3});
    graph.image("strange", {8, 8, VK_FORMAT_ASTC_4x4_UNORM_BLOCK});
    graph.raster("nothing");
    graph::ComputePass& lost = graph.compute("lost", "x.comp");
    lost.sample("input", graph::ImageId{});
    lost.dispatch(1, 1);
    graph::RasterPass& wrong = graph.raster("wrong");
    wrong.color(graph.image("depth", depth_target), {});
    wrong.draw("wrong");
    const std::string text = mistakes(graph);
    EXPECT_THAT(text, HasSubstr("image flat: its size is 0 x 8"));
    EXPECT_THAT(text, HasSubstr("image odd: 3 samples"));
    EXPECT_THAT(text, HasSubstr("image strange: its format"));
    EXPECT_THAT(text, HasSubstr("pass nothing: has no target"));
    EXPECT_THAT(text, HasSubstr("pass nothing: draws nothing"));
    EXPECT_THAT(text, HasSubstr("pass lost: uses an image that is not declared"));
    EXPECT_THAT(text, HasSubstr("pass lost: stores to no image"));
    EXPECT_THAT(text,
                HasSubstr("pass wrong: uses depth as colour target, which its depth format does not allow"));
    EXPECT_THAT(text, HasSubstr("pass wrong: draw wrong has neither a mesh nor a number of vertices"));
}

} // namespace
