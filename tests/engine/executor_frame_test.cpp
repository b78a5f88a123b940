// Frames on a device: times and counts, frames in flight, mistakes. Every test runs with validation on.
#include "base/input_error.hpp"
#include "engine/gpu/executor.hpp"
#include "tests/support/gpu.hpp"

#include <cstring>
#include <gmock/gmock.h>

#include "small_passes.hpp"

namespace {

using namespace small_passes;
using testing::ElementsAre;
using testing::HasSubstr;

using ExecutorTest = gpu_test::Test;

TEST_F(ExecutorTest, TimesEveryPassThatRanIncludingComputePasses)
{
    ASSERT_TRUE(gpu_test::device().info().timestamps);
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const std::vector<glm::vec2> work(60000);
    const auto frame = [&](float color) {
        graph::Graph graph;
        graph.readback("shown", add_show(graph, add_fill(graph, {.color = glm::vec3(color)}, work)));
        return executor.run(graph);
    };
    // Once a render pass has run, llvmpipe's timestamps before a dispatch need a barrier after them.
    frame(0);
    const gpu::FrameResult result = frame(1);
    const double compute = result.pass("fill").gpu_ms.value(), raster = result.pass("show").gpu_ms.value();
    EXPECT_GT(compute, 0.1 * result.frame_ms) << "nearly all the frame's work";
    EXPECT_GE(raster, 0.0);
    EXPECT_GE(result.gpu_ms.value(), compute + raster);
    EXPECT_LE(result.gpu_ms.value(), result.frame_ms);
    EXPECT_GT(result.pass("fill").cpu_ms, 0.0);
    const gpu::FrameResult still = frame(1);
    EXPECT_FALSE(still.pass("fill").gpu_ms) << "a skipped pass has no time";
}

TEST_F(ExecutorTest, PutsCpuAndGpuOnOneTimeline)
{
    for (const bool align : {false, true}) {
        gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
        executor.measure({.align = align});
        const std::vector<glm::vec2> work(20000);
        for (int i = 0; i < 3; ++i) {
            graph::Graph graph;
            graph.readback("shown", add_show(graph, add_fill(graph, {.step = float(i)}, work)));
            const gpu::FrameResult result = executor.run(graph);
            EXPECT_EQ(result.alignment, align && gpu_test::device().info().calibrated
                                            ? gpu::Alignment::Calibrated
                                            : gpu::Alignment::Bounds);
            const gpu::HostTimes& host = result.host;
            const double recorded = host.schedule_ms + host.record_ms;
            EXPECT_NEAR(recorded + host.submit_ms + host.wait_ms + host.readback_ms, result.frame_ms, 1e-6);
            // Successive passes do not overlap on the CPU or on the GPU, from submission to the fence.
            double gpu = recorded, cpu = host.schedule_ms;
            for (const gpu::PassResult& pass : result.passes) {
                EXPECT_GE(pass.cpu_begin_ms, cpu) << pass.name;
                cpu = pass.cpu_begin_ms + pass.cpu_ms;
                EXPECT_GE(pass.gpu_begin_ms.value(), gpu - result.alignment_error_ms - 1e-6) << pass.name;
                gpu = *pass.gpu_begin_ms + pass.gpu_ms.value();
            }
            EXPECT_LE(cpu, recorded);
            EXPECT_GE(result.copy.value().begin_ms, gpu - 1e-6);
            EXPECT_LE(result.copy->end_ms(),
                      recorded + host.submit_ms + host.wait_ms + result.alignment_error_ms);
        }
    }
}

TEST_F(ExecutorTest, CountsInvocationsAndBytesOfPassesThatRan)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const auto frame = [&] {
        graph::Graph graph;
        graph.readback("shown", add_show(graph, add_fill(graph, {})));
        return executor.run(graph);
    };
    EXPECT_FALSE(frame().pass("fill").invocations) << "nothing is counted unless asked for";
    executor.forget();
    executor.measure({.count = true});
    const gpu::FrameResult counted = frame();
    constexpr std::uint64_t texels = std::uint64_t{small_float.width} * small_float.height;
    for (const char* name : {"fill", "show"})
        EXPECT_EQ(counted.pass(name).work.bytes_written, 16 * texels) << name;
    if (gpu_test::device().info().statistics) {
        const gpu::Invocations fill = counted.pass("fill").invocations.value(),
                               show = counted.pass("show").invocations.value();
        EXPECT_GE(fill.compute, texels); // whole workgroups
        EXPECT_LT(fill.compute, 4 * texels);
        EXPECT_EQ(fill.fragment + fill.vertex + show.compute, 0u);
        EXPECT_EQ(show.vertex, 3u);
        EXPECT_GE(show.fragment, texels);
    } else {
        EXPECT_FALSE(counted.pass("fill").invocations);
    }
    const gpu::FrameResult still = frame();
    EXPECT_EQ(still.pass("fill").work.bytes_written, 0u);
    EXPECT_FALSE(still.pass("fill").invocations);
    EXPECT_FALSE(still.pass("fill").gpu_begin_ms);
}

TEST_F(ExecutorTest, OnlyWhatIsStoredCountsAsWritten)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    const graph::ImageId filled = add_fill(graph, {});
    const graph::ImageId many = graph.image("many", {8, 8, VK_FORMAT_R8G8B8A8_UNORM, 4}),
                         one = graph.image("one", {8, 8, VK_FORMAT_R8G8B8A8_UNORM}),
                         depth = graph.image("depth", {8, 8, VK_FORMAT_D32_SFLOAT, 4});
    graph::RasterPass& show = graph.raster("show");
    show.color(many, {0, 0, 0, 0}, one);
    show.depth(depth);
    show.sample("source", filled, graph::Sampler::NearestClamp);
    show.uniform("Tint", glm::vec4(1));
    show.draw("test_quad").index_count = 3;
    graph.readback("one", one);
    EXPECT_EQ(executor.run(graph).pass("show").work.bytes_written, 8u * 8 * 4)
        << "neither the samples nor the depth are needed once resolved";
}

TEST_F(ExecutorTest, TwoFramesInFlightKeepTheirOwnResults)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    std::vector<gpu::FrameToken> tokens;
    std::vector<float> seen;
    for (int i = 0; i < 6; ++i) {
        graph::Graph graph;
        graph.readback("shown", add_show(graph, add_fill(graph, {.color = glm::vec3(float(i))})));
        tokens.push_back(executor.submit(graph));
        if (i > 0)
            seen.push_back(
                executor.finish(tokens[tokens.size() - 2]).mat(graph::ReadbackId{0}).at<cv::Vec4f>(5, 5)[0]);
    }
    EXPECT_THAT(seen, ElementsAre(0.0f, 1.0f, 2.0f, 3.0f, 4.0f));
    EXPECT_THROW(executor.finish(tokens[0]), std::logic_error);
}

TEST_F(ExecutorTest, ThePresentedImageCanBeCopiedAfterTheFrame)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    graph.present(add_fill(graph, {}));
    const gpu::FrameResult result = executor.run(graph);
    const gpu::Buffer copy(gpu_test::device(), std::size_t{16} * small_float.width * small_float.height,
                           VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::HostAccess::Read, "copy");
    gpu_test::device().run_once([&](VkCommandBuffer commands) {
        const VkBufferImageCopy region{
            .imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
            .imageExtent = {small_float.width, small_float.height, 1}};
        vkCmdCopyImageToBuffer(commands, executor.presented("filled"), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               copy.handle(), 1, &region);
    });
    copy.invalidate();
    float first = 0;
    std::memcpy(&first, copy.mapped().data(), sizeof first);
    EXPECT_EQ(first, 0.25f);
    EXPECT_THAT(states(executor.run(graph)), ElementsAre("fill skipped: unchanged"));
}

TEST_F(ExecutorTest, AWrongDeclarationNamesAllMistakesAndTheExecutorStaysUsable)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph good;
    good.readback("filled", add_fill(good, {}));
    executor.run(good);
    graph::Graph bad;
    const graph::ImageId filled = add_fill(bad, {});
    std::get<graph::ComputePass>(bad.passes.back()).uniform("colour", 1.0f);
    bad.readback("shown", add_show(bad, bad.image("orphan", small_float)));
    bad.readback("filled", filled);
    try {
        executor.run(bad);
        FAIL() << "nothing was thrown";
    } catch (const std::logic_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("pass show: samples orphan, which no pass writes"));
        EXPECT_THAT(error.what(),
                    HasSubstr("pass fill: shader test_fill.comp has no binding or constant colour"));
    }
    EXPECT_THAT(states(executor.run(good)), ElementsAre("fill skipped: unchanged"));
}

TEST_F(ExecutorTest, AnImageTooLargeForTheDeviceIsAnInputErrorAndTheExecutorStaysUsable)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const auto frame = [&](std::uint32_t width) {
        graph::Graph graph;
        const graph::ImageId image = graph.image("filled", {width, 1, VK_FORMAT_R32G32B32A32_SFLOAT});
        graph::ComputePass& fill = graph.compute("fill", "test_fill.comp");
        fill.store("result", image);
        fill.uniform("params", FillParams{});
        fill.buffer<glm::vec2>("Offsets", {});
        fill.dispatch(width, 1);
        graph.readback("filled", image);
        return executor.run(graph).mat(graph::ReadbackId{0}).at<cv::Vec4f>(0, 0)[0];
    };
    EXPECT_EQ(frame(8), 0.25f);
    EXPECT_THROW(frame(1u << 20), base::InputError);
    EXPECT_EQ(frame(8), 0.25f);
}

TEST_F(ExecutorTest, AFrameWithoutOutputsIsNoError)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    EXPECT_TRUE(executor.run(graph::Graph{}).passes.empty());
    graph::Graph graph;
    add_fill(graph, {});
    EXPECT_THAT(states(executor.run(graph)), ElementsAre("fill culled: unused: nothing samples filled"));
}

} // namespace
