#include "engine/executor.hpp"
#include "engine/mesh_buffer.hpp"
#include "engine/texture.hpp"
#include "tests/gpu.hpp"

#include <gmock/gmock.h>

namespace {

using namespace engine;
using testing::ElementsAre;
using testing::HasSubstr;

struct FillParams
{
    glm::vec3 color{0.25f, 0.5f, 0.75f};
    float step = 0.0f;
};

constexpr ImageDesc small_float{20, 12, VK_FORMAT_R32G32B32A32_SFLOAT};

/// A compute pass that fills "filled".
ImageId add_fill(Graph& graph, const FillParams& params, const std::vector<glm::vec2>& offsets = {})
{
    const ImageId filled = graph.image("filled", small_float);
    ComputePass& fill = graph.compute("fill", "test_fill.comp");
    fill.store("result", filled);
    fill.uniform("params", params);
    fill.buffer<glm::vec2>("Offsets", offsets);
    fill.dispatch(small_float.width, small_float.height);
    return filled;
}

/// A raster pass that shows `source` in "shown".
ImageId add_show(Graph& graph, ImageId source, glm::vec4 tint = glm::vec4(1.0f))
{
    const ImageId shown = graph.image("shown", small_float);
    RasterPass& show = graph.raster("show");
    show.color(shown, {0, 0, 0, 0});
    show.sample("source", source, Sampler::NearestClamp);
    show.uniform("Tint", tint);
    show.draw("test_quad").index_count = 3;
    return shown;
}

using ExecutorTest = gpu::Test;

TEST_F(ExecutorTest, ComputeReachesEveryTexelAndIsReadBackRowTight)
{
    Executor executor(gpu::device(), gpu::shaders());
    Graph graph;
    const ReadbackId back = graph.readback("filled", add_fill(graph, {.step = 1.0f}));
    const FrameResult result = executor.run(graph);
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
    Executor executor(gpu::device(), gpu::shaders());
    Graph graph;
    const ImageId shown = add_show(graph, add_fill(graph, {.step = 1.0f}), glm::vec4(2.0f));
    const ReadbackId back = graph.readback("shown", shown);
    const cv::Mat picture = executor.run(graph).mat(back).clone();
    EXPECT_EQ(picture.at<cv::Vec4f>(11, 19), cv::Vec4f(38.5f, 23.0f, 1.5f, 2.0f));
}

} // namespace
