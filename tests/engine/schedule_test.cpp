// The schedule: order, culling, skipping, barriers, stores and lifetimes. No device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scheduled_passes.hpp"

namespace {

using testing::ElementsAre;
using namespace scheduled_passes;

/// warp -> forward (every frame) -> tonemap -> readback, as in the renderer.
struct Face
{
    explicit Face(float day, float light = 1)
    {
        const graph::ImageId wound = add_compute(graph, "warp", {}, day);
        const graph::ImageId lit = add_raster(graph, "forward", {wound}, true);
        std::get<graph::RasterPass>(graph.passes.back()).uniform("light", light);
        graph.readback("picture", add_raster(graph, "tonemap", {lit}));
    }
    graph::Graph graph;
};

// ---- Order and culling

TEST(Schedule, KeepsTheDeclaredOrderWherePossibleAndPutsWritersFirst)
{
    graph::Graph graph;
    const graph::ImageId late = graph.image("late_out", target);
    const graph::ImageId early = add_compute(graph, "reader", {late});
    const graph::ImageId other = add_compute(graph, "other");
    graph::ComputePass& writer = graph.compute("late", "late.comp");
    writer.store("output", late);
    writer.dispatch(1, 1);
    graph.readback("a", early);
    graph.readback("b", other);
    std::vector<std::string> order;
    for (const graph::PassPlan& pass : graph::schedule(graph, {}).passes)
        order.push_back(pass.name);
    EXPECT_THAT(order, ElementsAre("other", "late", "reader"));
}

TEST(Schedule, CullsWhatLeadsToNoOutputAndSaysWhy)
{
    graph::Graph graph;
    const graph::ImageId a = add_compute(graph, "a");
    add_compute(graph, "b", {a});
    graph.readback("picture", add_compute(graph, "c"));
    EXPECT_EQ(trace(graph::schedule(graph, {})),
              "a culled: unused: only b samples a_out, and it is culled | "
              "b culled: unused: nothing samples b_out | c ran: first run");
}

TEST(Schedule, APresentedImageIsAnOutput)
{
    graph::Graph graph;
    const graph::ImageId a = add_compute(graph, "a");
    graph.present(a);
    const graph::Plan plan = graph::schedule(graph, {});
    EXPECT_EQ(trace(plan), "a ran: first run");
    ASSERT_EQ(plan.final_barriers.size(), 1u);
    EXPECT_EQ(plan.final_barriers[0].barrier.new_layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
}

// ---- Skipping

TEST(Schedule, AnUnchangedFrameRunsOnlyWhatMustRunEachFrameAndWhatSamplesIt)
{
    const graph::Plan first = graph::schedule(Face(3).graph, {});
    EXPECT_EQ(trace(first), "warp ran: first run | forward ran: every frame | tonemap ran: first run");
    const graph::Plan second = graph::schedule(Face(3).graph, first.memory);
    EXPECT_EQ(trace(second),
              "warp skipped: unchanged | forward ran: every frame | tonemap ran: changed: input forward_out");
}

TEST(Schedule, AChangedUniformRerunsItsPassAndItsReaders)
{
    graph::Memory memory;
    const auto build = [](float first, float second) {
        graph::Graph graph;
        const graph::ImageId a = add_compute(graph, "a", {}, first);
        const graph::ImageId b = add_compute(graph, "b", {}, second);
        graph.readback("picture", add_compute(graph, "c", {a, b}));
        return graph;
    };
    memory = graph::schedule(build(1, 2), memory).memory;
    graph::Plan plan = graph::schedule(build(1, 3), memory);
    EXPECT_EQ(trace(plan),
              "a skipped: unchanged | b ran: changed: uniform value | c ran: changed: input b_out");
    plan = graph::schedule(build(1, 3), plan.memory);
    EXPECT_EQ(trace(plan), "a skipped: unchanged | b skipped: unchanged | c skipped: unchanged");
}

TEST(Schedule, AChangedLightRerunsOnlyPassesThatUseIt)
{
    const graph::Plan first = graph::schedule(Face(3, 1).graph, {});
    const graph::Plan second = graph::schedule(Face(3, 2).graph, first.memory);
    EXPECT_EQ(pass_plan(second, "warp").state, graph::PassState::Skipped);
    EXPECT_EQ(pass_plan(second, "forward").state, graph::PassState::Run);
}

TEST(Schedule, EverythingAPassDeclaresIsInItsKey)
{
    struct Case
    {
        const char* reason;
        void (*change)(graph::RasterPass&, graph::Draw&);
    };
    const Case cases[] = {
        {"changed: targets", [](graph::RasterPass& pass, graph::Draw&) { pass.colors[0].clear[1] = 0.5f; }},
        {"changed: targets", [](graph::RasterPass& pass, graph::Draw&) { pass.depth_clear = 0.5f; }},
        {"changed: uniform view", [](graph::RasterPass& pass, graph::Draw&) { pass.uniform("view", 2.0f); }},
        {"changed: constant on", [](graph::RasterPass& pass, graph::Draw&) { pass.constant("on", false); }},
        {"changed: draw", [](graph::RasterPass&, graph::Draw& draw) { draw.shader = "other"; }},
        {"changed: draw", [](graph::RasterPass&, graph::Draw& draw) { draw.first_index = 3; }},
        {"changed: draw", [](graph::RasterPass&, graph::Draw& draw) { draw.index_count = 6; }},
        {"changed: draw", [](graph::RasterPass&, graph::Draw& draw) { draw.cull_back_faces = false; }},
        {"changed: draw", [](graph::RasterPass&, graph::Draw& draw) { draw.blend = true; }},
        {"changed: draw", [](graph::RasterPass&, graph::Draw& draw) { draw.depth_test = false; }},
        {"changed: draw", [](graph::RasterPass&, graph::Draw& draw) { draw.depth_write = false; }},
        {"changed: buffer points",
         [](graph::RasterPass&, graph::Draw& draw) {
             draw.buffer<float>("points", std::vector{1.0f, 3.0f});
         }},
        {"changed: samplers",
         [](graph::RasterPass&, graph::Draw& draw) {
             draw.sampled[0].sampler = graph::Sampler::NearestClamp;
         }},
        {"changed: draw 0: draw",
         [](graph::RasterPass& pass, graph::Draw&) { pass.draw("test").index_count = 3; }},
    };
    const auto build = [](const Case* changed) {
        graph::Graph graph;
        const graph::ImageId input = graph.import("albedo", graph::ExternalImage{target, VK_NULL_HANDLE, 5});
        const graph::ImageId output = graph.image("out", target);
        graph::RasterPass& pass = graph.raster("pass");
        pass.color(output, {0, 0, 0, 1});
        pass.uniform("view", 1.0f);
        pass.constant("on", true);
        graph::Draw& draw = pass.draw("test");
        draw.index_count = 3;
        draw.sample("albedo", input);
        draw.buffer<float>("points", std::vector{1.0f, 2.0f});
        if (changed)
            changed->change(pass, draw);
        graph.readback("out", output);
        return graph;
    };
    const graph::Memory memory = graph::schedule(build(nullptr), {}).memory;
    ASSERT_EQ(trace(graph::schedule(build(nullptr), memory)), "pass skipped: unchanged");
    for (const Case& c : cases)
        EXPECT_EQ(trace(graph::schedule(build(&c), memory)), std::string("pass ran: ") + c.reason);
}

TEST(Schedule, ReplacingAnImportedTextureRerunsItsReaders)
{
    const auto build = [](std::uint64_t content) {
        graph::Graph graph;
        const graph::ImageId texture =
            graph.import("albedo", graph::ExternalImage{target, VK_NULL_HANDLE, content});
        graph.readback("picture", add_compute(graph, "a", {texture}));
        return graph;
    };
    const graph::Memory memory = graph::schedule(build(1), {}).memory;
    EXPECT_EQ(trace(graph::schedule(build(2), memory)), "a ran: changed: input albedo");
}

TEST(Schedule, AResizedImageIsWrittenAgain)
{
    const auto build = [](std::uint32_t width) {
        graph::Graph graph;
        const graph::ImageId output = graph.image("out", {width, 32, VK_FORMAT_R8G8B8A8_UNORM});
        graph::ComputePass& pass = graph.compute("a", "a.comp");
        pass.store("output", output);
        pass.dispatch(8, 8);
        graph.readback("out", output);
        return graph;
    };
    const graph::Plan first = graph::schedule(build(64), {});
    const graph::Plan second = graph::schedule(build(65), first.memory);
    EXPECT_EQ(trace(second), "a ran: changed: size of out");
    EXPECT_EQ(pass_plan(second, "a").barriers.at(0).barrier.src_stages, 0u)
        << "nothing has used the new image yet";
}

TEST(Schedule, AnImageWithANewUsageIsRecreatedAndWrittenAgain)
{
    const auto build = [](bool read_back) {
        graph::Graph graph;
        const graph::ImageId a = add_compute(graph, "a");
        graph.readback("picture", add_compute(graph, "b", {a}));
        if (read_back)
            graph.readback("a", a);
        return graph;
    };
    const graph::Memory memory = graph::schedule(build(false), {}).memory;
    EXPECT_EQ(trace(graph::schedule(build(true), memory)),
              "a ran: changed: the contents of a_out were not kept | b skipped: unchanged");
}

TEST(Schedule, ContentsOutliveTheFramesInWhichTheyAreCulled)
{
    const auto build = [](bool wounded) {
        graph::Graph graph;
        const graph::ImageId wound = add_compute(graph, "warp");
        graph.readback("picture",
                       wounded ? add_raster(graph, "forward", {wound}) : add_raster(graph, "plain", {}));
        return graph;
    };
    graph::Memory memory = graph::schedule(build(true), {}).memory;
    const graph::Plan without = graph::schedule(build(false), memory);
    EXPECT_EQ(pass_plan(without, "warp").state, graph::PassState::Culled);
    EXPECT_EQ(pass_plan(graph::schedule(build(true), without.memory), "warp").state,
              graph::PassState::Skipped);
}

TEST(Schedule, ContentsThatWereNotStoredAreNotTrusted)
{
    const auto build = [](bool sample_depth) {
        graph::Graph graph;
        const graph::ImageId depth = graph.image("depth", depth_target);
        const graph::ImageId lit = add_raster(graph, "forward", {});
        std::get<graph::RasterPass>(graph.passes.back()).depth(depth);
        graph.readback("picture", lit);
        // The usage of the image is the same either way, only the need for its contents differs.
        const graph::ImageId edges = add_compute(graph, "edges", {depth});
        if (sample_depth)
            graph.readback("edges", edges);
        return graph;
    };
    const graph::Plan first = graph::schedule(build(false), {});
    EXPECT_EQ(pass_plan(first, "forward").depth_store, VK_ATTACHMENT_STORE_OP_DONT_CARE);
    EXPECT_EQ(pass_plan(first, "forward").color_stores, std::vector{VK_ATTACHMENT_STORE_OP_STORE});
    graph::Plan second = graph::schedule(build(true), first.memory);
    EXPECT_EQ(pass_plan(second, "forward").reason, "changed: the contents of depth were not kept");
    EXPECT_EQ(pass_plan(second, "forward").depth_store, VK_ATTACHMENT_STORE_OP_STORE);
    second = graph::schedule(build(true), second.memory);
    EXPECT_EQ(pass_plan(second, "forward").state, graph::PassState::Skipped);
}

// ---- Barriers, stores, lifetimes

TEST(Schedule, ASkippedPassHasNoBarriersAndItsImageNeedsNoneToBeSampledAgain)
{
    const graph::Plan first = graph::schedule(Face(3).graph, {});
    const graph::Plan second = graph::schedule(Face(3).graph, first.memory);
    EXPECT_TRUE(pass_plan(second, "warp").barriers.empty());
    ASSERT_EQ(pass_plan(second, "forward").barriers.size(), 1u)
        << "its own target; warp_out is still readable";
    EXPECT_EQ(second.passes[1].barriers[0].image, graph::ImageId{1});
}

TEST(Schedule, ImportedTexturesNeedNoBarriers)
{
    graph::Graph graph;
    const graph::ImageId texture = graph.import("albedo", graph::ExternalImage{target, VK_NULL_HANDLE, 7});
    graph.readback("picture", add_raster(graph, "forward", {texture}));
    const graph::Plan plan = graph::schedule(graph, {});
    ASSERT_EQ(plan.passes[0].barriers.size(), 1u);
    EXPECT_NE(plan.passes[0].barriers[0].image, texture);
}

TEST(Schedule, MultisampledImagesAreResolvedAndNotStored)
{
    graph::Graph graph;
    graph::ImageDesc samples = target, depth = depth_target;
    samples.samples = depth.samples = 4;
    const graph::ImageId many = graph.image("many", samples), one = graph.image("one", target);
    graph::RasterPass& pass = graph.raster("forward");
    pass.color(many, {0, 0, 0, 1}, one);
    pass.depth(graph.image("depth", depth));
    pass.draw("forward").index_count = 3;
    graph.readback("one", one);
    const graph::Plan plan = graph::schedule(graph, {});
    EXPECT_EQ(plan.passes[0].color_stores, std::vector{VK_ATTACHMENT_STORE_OP_DONT_CARE});
    EXPECT_EQ(plan.passes[0].resolve_stores, std::vector{VK_ATTACHMENT_STORE_OP_STORE});
    EXPECT_EQ(plan.passes[0].depth_store, VK_ATTACHMENT_STORE_OP_DONT_CARE);
    EXPECT_EQ(plan.passes[0].barriers.size(), 3u);
    EXPECT_EQ(plan.images[many.index].usage, VkImageUsageFlags{VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT});
    EXPECT_FALSE(plan.images[many.index].needed);
}

TEST(Schedule, LifetimesSpanFromTheWriterToTheLastReader)
{
    graph::Graph graph;
    const graph::ImageId a = add_compute(graph, "a");
    const graph::ImageId b = add_compute(graph, "b", {a});
    const graph::ImageId unused = add_compute(graph, "unused", {a});
    graph.readback("picture", add_compute(graph, "c", {a, b}));
    const graph::Plan plan = graph::schedule(graph, {});
    EXPECT_EQ(plan.images[a.index].first, 0u);
    EXPECT_EQ(plan.images[a.index].last, 3u);
    EXPECT_EQ(plan.images[b.index].first, 1u);
    EXPECT_EQ(plan.images[b.index].last, 3u);
    EXPECT_EQ(plan.images[unused.index].first, ~0u);
}

} // namespace
