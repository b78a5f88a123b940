// Frames on a device: results, skipped passes, timings. Every test runs with validation on.
#include "base/input_error.hpp"
#include "engine/gpu/executor.hpp"
#include "tests/support/gpu.hpp"

#include <cstring>
#include <glm/glm.hpp>
#include <gmock/gmock.h>

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct FillParams
{
    glm::vec3 color{0.25f, 0.5f, 0.75f};
    float step = 0.0f;
};

constexpr graph::ImageDesc small_float{20, 12, VK_FORMAT_R32G32B32A32_SFLOAT};

/// A compute pass that fills "filled".
graph::ImageId add_fill(graph::Graph& graph, const FillParams& params,
                        const std::vector<glm::vec2>& offsets = {})
{
    const graph::ImageId filled = graph.image("filled", small_float);
    graph::ComputePass& fill = graph.compute("fill", "test_fill.comp");
    fill.store("result", filled);
    fill.uniform("params", params);
    fill.buffer("Offsets", offsets);
    fill.dispatch(small_float.width, small_float.height);
    return filled;
}

/// A raster pass that shows `source` in "shown".
graph::ImageId add_show(graph::Graph& graph, graph::ImageId source, glm::vec4 tint = glm::vec4(1.0f))
{
    const graph::ImageId shown = graph.image("shown", small_float);
    graph::RasterPass& show = graph.raster("show");
    show.color(shown, {0, 0, 0, 0});
    show.sample("source", source, graph::Sampler::NearestClamp);
    show.uniform("Tint", tint);
    show.draw("test_quad").index_count = 3;
    return shown;
}

/// One text per pass such as "fill ran: first run", in order of execution.
std::vector<std::string> states(const gpu::FrameResult& result)
{
    std::vector<std::string> list;
    for (const gpu::PassResult& pass : result.passes)
        list.push_back(pass.name + " " + graph::name_of(pass.state) + ": " + pass.reason);
    return list;
}

using ExecutorTest = gpu_test::Test;

TEST_F(ExecutorTest, ComputeWritesEveryTexelAndReadbackRowsArePacked)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    const graph::ReadbackId back = graph.readback("filled", add_fill(graph, {.step = 1.0f}));
    const gpu::FrameResult result = executor.run(graph);
    const cv::Mat picture = result.mat(back);
    ASSERT_EQ(picture.type(), CV_32FC4);
    ASSERT_EQ(picture.cols, 20);
    ASSERT_EQ(picture.rows, 12);
    for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.cols; ++x)
            ASSERT_EQ(picture.at<cv::Vec4f>(y, x), cv::Vec4f(0.25f + float(x), 0.5f + float(y), 0.75f, 1.0f));
}

TEST_F(ExecutorTest, RasterSamplesWhatComputeWrote)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    const graph::ImageId shown = add_show(graph, add_fill(graph, {.step = 1.0f}), glm::vec4(2.0f));
    const graph::ReadbackId back = graph.readback("shown", shown);
    const cv::Mat picture = executor.run(graph).mat(back).clone();
    EXPECT_EQ(picture.at<cv::Vec4f>(11, 19), cv::Vec4f(38.5f, 23.0f, 1.5f, 2.0f));
}

TEST_F(ExecutorTest, AnUnchangedFrameRunsNothingAndStillReadsBackTheSame)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const auto frame = [&] {
        graph::Graph graph;
        graph.readback("shown", add_show(graph, add_fill(graph, {.step = 1.0f})));
        return executor.run(graph);
    };
    const gpu::FrameResult first = frame(), second = frame();
    EXPECT_THAT(states(first), ElementsAre("fill ran: first run", "show ran: first run"));
    EXPECT_THAT(states(second), ElementsAre("fill skipped: unchanged", "show skipped: unchanged"));
    EXPECT_EQ(first.readbacks[0].bytes, second.readbacks[0].bytes);
}

TEST_F(ExecutorTest, AfterForgetEveryPassRunsAgain)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    graph.readback("filled", add_fill(graph, {}));
    executor.run(graph);
    executor.forget();
    EXPECT_THAT(states(executor.run(graph)), ElementsAre("fill ran: first run"));
}

TEST_F(ExecutorTest, UpToDateTellsWhetherAFrameWouldRunAPass)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const auto frame = [](float step) {
        graph::Graph graph;
        graph.readback("filled", add_fill(graph, {.step = step}));
        return graph;
    };
    EXPECT_FALSE(executor.up_to_date(frame(1)));
    executor.run(frame(1));
    EXPECT_TRUE(executor.up_to_date(frame(1)));
    EXPECT_FALSE(executor.up_to_date(frame(2)));
    graph::Graph always = frame(1);
    std::get<graph::ComputePass>(always.passes.front()).every_frame();
    EXPECT_FALSE(executor.up_to_date(always));
}

/// A new tint, and a new step, touch the region only, says the pass.
graph::Graph spot_frame(float step, float tint, const graph::Region& region)
{
    graph::Graph graph;
    const graph::ImageId filled = add_fill(graph, {.step = step});
    auto& fill = std::get<graph::ComputePass>(graph.passes.back());
    fill.confine("params", region);
    graph.readback("shown", add_show(graph, filled, glm::vec4(tint)));
    auto& show = std::get<graph::RasterPass>(graph.passes.back());
    show.confine("Tint", region);
    show.in_place(filled);
    return graph;
}

TEST_F(ExecutorTest, AConfinedChangeWritesItsRegionAndKeepsTheRest)
{
    constexpr graph::Region region{3, 2, 9, 7};
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    executor.run(spot_frame(1, 1, region));
    const gpu::FrameResult second = executor.run(spot_frame(2, 3, region));
    EXPECT_NEAR(second.pass("show").refreshed, 63 / 240., 1e-12);
    EXPECT_EQ(second.pass("show").bytes_written, 63u * 16);
    const cv::Mat4f shown = second.mat({0});
    for (int y = 0; y < shown.rows; ++y)
        for (int x = 0; x < shown.cols; ++x) {
            const bool inside = x >= 3 && x < 12 && y >= 2 && y < 9;
            // Compute writes whole work groups of the region: 8 x 8 of them cover this image's first 16 columns.
            ASSERT_EQ(shown(y, x)[0], inside ? 3 * (0.25f + 2 * float(x)) : 0.25f + float(x)) << x << ' ' << y;
        }
}

TEST_F(ExecutorTest, TheCheckFindsARegionThatIsTooSmall)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    executor.measure({.check_regions = true});
    executor.run(spot_frame(1, 1, {0, 0, 20, 12}));
    EXPECT_NO_THROW(executor.run(spot_frame(1, 2, {0, 0, 20, 12})));
    try {
        executor.run(spot_frame(1, 3, {0, 0, 20, 11}));
        executor.run(spot_frame(1, 4, {0, 0, 20, 11}));
        FAIL() << "not found";
    } catch (const std::logic_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("shown is outdated at texel 0, 11"));
    }
}

TEST_F(ExecutorTest, APrefixDistinguishesTwoCopiesOfTheSamePass)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    const graph::ReadbackId plain = graph.readback("a", add_fill(graph, {.step = 1}));
    graph.prefix("other ");
    const graph::ReadbackId other = graph.readback("b", add_fill(graph, {.step = 2}));
    const gpu::FrameResult result = executor.run(graph);
    EXPECT_THAT(states(result), ElementsAre("fill ran: first run", "other fill ran: first run"));
    EXPECT_EQ(result.mat(plain).at<cv::Vec4f>(0, 1)[0], 1.25f);
    EXPECT_EQ(result.mat(other).at<cv::Vec4f>(0, 1)[0], 2.25f);
}

TEST_F(ExecutorTest, KeepsDataAliveUntilTheFrameIsFinished)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    auto used = std::make_shared<int>(0);
    const std::weak_ptr<int> alive = used;
    gpu::FrameToken token;
    {
        graph::Graph graph;
        graph.readback("filled", add_fill(graph, {}));
        graph.keep(std::move(used));
        token = executor.submit(graph);
    }
    EXPECT_FALSE(alive.expired());
    executor.finish(token);
    EXPECT_TRUE(alive.expired());
}

TEST_F(ExecutorTest, AChangedUniformRerunsItsPassAndItsReaders)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const auto frame = [&](float step, float tint) {
        graph::Graph graph;
        graph.readback("shown", add_show(graph, add_fill(graph, {.step = step}), glm::vec4(tint)));
        return executor.run(graph);
    };
    frame(1, 1);
    EXPECT_THAT(states(frame(1, 2)),
                ElementsAre("fill skipped: unchanged", "show ran: changed: uniform Tint"));
    const gpu::FrameResult result = frame(2, 2);
    EXPECT_THAT(states(result),
                ElementsAre("fill ran: changed: uniform params", "show ran: changed: input filled"));
    EXPECT_EQ(result.mat(graph::ReadbackId{0}).at<cv::Vec4f>(0, 19)[0], 2.0f * (0.25f + 2.0f * 19.0f));
}

TEST_F(ExecutorTest, EveryFramePassesRunAlwaysAndCulledOnesNever)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    for (int i = 0; i < 3; ++i) {
        graph::Graph graph;
        const graph::ImageId filled = add_fill(graph, {});
        const graph::ImageId shown = add_show(graph, filled);
        std::get<graph::RasterPass>(graph.passes.back()).every_frame();
        graph::ComputePass& unused = graph.compute("unused", "test_fill.comp");
        unused.store("result", graph.image("unused_image", small_float));
        unused.uniform("params", FillParams{});
        unused.buffer<glm::vec2>("Offsets", {});
        unused.dispatch(1, 1);
        graph.readback("shown", shown);
        EXPECT_THAT(states(executor.run(graph)),
                    ElementsAre(i == 0 ? "fill ran: first run" : "fill skipped: unchanged",
                                "show ran: every frame",
                                "unused culled: unused: nothing samples unused_image"));
    }
}

TEST_F(ExecutorTest, ConstantsAndBuffersReachTheShader)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const auto first_texel = [&](float gain, const std::vector<glm::vec2>& offsets) {
        graph::Graph graph;
        const graph::ImageId filled = add_fill(graph, {.step = 1.0f}, offsets);
        std::get<graph::ComputePass>(graph.passes.back()).constant("gain", gain);
        const graph::ReadbackId back = graph.readback("filled", filled);
        return executor.run(graph).mat(back).at<cv::Vec4f>(0, 0);
    };
    EXPECT_EQ(first_texel(1.0f, {}), cv::Vec4f(0.25f, 0.5f, 0.75f, 1.0f))
        << "an empty buffer is one element of zeros";
    EXPECT_EQ(first_texel(2.0f, {{1, 2}, {3, 5}}), cv::Vec4f(0.5f + 4.0f, 1.0f + 7.0f, 1.5f, 1.0f));
    // Larger than a block of the upload arena; llvmpipe ends every loop after 65535 iterations.
    EXPECT_EQ(first_texel(1.0f, std::vector<glm::vec2>(50000, {1, 0}))[0], 50000.25f);
}

TEST_F(ExecutorTest, AResizedImageIsRecreated)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    for (const std::uint32_t width : {33u, 7u, 64u}) {
        graph::Graph graph;
        const graph::ImageId image = graph.image("filled", {width, 5, VK_FORMAT_R32G32B32A32_SFLOAT});
        graph::ComputePass& fill = graph.compute("fill", "test_fill.comp");
        fill.store("result", image);
        fill.uniform("params", FillParams{.step = 1.0f});
        fill.buffer<glm::vec2>("Offsets", {});
        fill.dispatch(width, 5);
        const graph::ReadbackId back = graph.readback("filled", image);
        const cv::Mat picture = executor.run(graph).mat(back).clone();
        ASSERT_EQ(picture.cols, static_cast<int>(width));
        EXPECT_EQ(picture.at<cv::Vec4f>(4, picture.cols - 1)[0], 0.25f + static_cast<float>(width - 1));
    }
}

// ---- Time, frames in flight, mistakes

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
        EXPECT_EQ(counted.pass(name).bytes_written, 16 * texels) << name;
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
    EXPECT_EQ(still.pass("fill").bytes_written, 0u);
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
    EXPECT_EQ(executor.run(graph).pass("show").bytes_written, 8u * 8 * 4)
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
