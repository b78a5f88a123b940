// Frames on a device: results, skipped passes, regions. Every test runs with validation on.
#include "engine/gpu/executor.hpp"
#include "tests/support/gpu.hpp"

#include <cstring>
#include <glm/glm.hpp>
#include <gmock/gmock.h>

#include "small_passes.hpp"

namespace {

using namespace small_passes;
using testing::ElementsAre;
using testing::HasSubstr;

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
    constexpr graph::Region region{9, 8, 5, 3}; // not in the first work group of 8 x 8
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const auto draw = [&](float step, float tint) {
        graph::Graph graph = spot_frame(step, tint, region);
        graph.readback("filled", graph::ImageId{0});
        return executor.run(graph);
    };
    draw(1, 1);
    const gpu::FrameResult second = draw(2, 3);
    EXPECT_NEAR(second.pass("show").work.refreshed, 15 / 240., 1e-12);
    EXPECT_EQ(second.pass("show").work.bytes_written, 15u * 16);
    const cv::Mat4f shown = second.mat({0}), filled = second.mat({1});
    for (int y = 0; y < shown.rows; ++y)
        for (int x = 0; x < shown.cols; ++x) {
            const bool inside = x >= 9 && x < 14 && y >= 8 && y < 11;
            const bool computed = x >= 8 && x < 16 && y >= 8; // whole work groups
            ASSERT_EQ(shown(y, x)[0], inside ? 3 * (0.25f + 2 * float(x)) : 0.25f + float(x))
                << x << ' ' << y;
            ASSERT_EQ(filled(y, x)[0], 0.25f + (computed ? 2 : 1) * float(x)) << x << ' ' << y;
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

} // namespace
