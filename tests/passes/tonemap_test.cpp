#include "passes/tonemap.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/color.hpp"
#include "base/tone_curve.hpp"
#include "engine/gpu/texture.hpp"
#include "tests/support/gpu.hpp"

namespace {

cv::Mat4b encode(const cv::Mat4f& linear, float exposure, passes::Highlights highlights,
                 const passes::Backdrop& backdrop = {})
{
    const gpu::Texture texture(gpu_test::device(), linear, gpu::Encoding::Linear, false, "hdr");
    graph::Graph graph;
    const graph::ImageId encoded =
        passes::add_tonemap(graph, graph.import("hdr", texture), exposure, highlights, backdrop);
    const graph::ReadbackId back = graph.readback("encoded", encoded);
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    return cv::Mat4b(executor.run(graph).mat(back).clone());
}

// 0 to 1.25 from left to right; the size is not a multiple of any workgroup.
cv::Mat4f ramp()
{
    cv::Mat4f image(3, 253);
    for (int x = 0; x < image.cols; ++x) {
        const float v = 1.25f * static_cast<float>(x) / 252;
        image.col(x) = cv::Scalar(v, v * v, 0.004f * v, 1);
    }
    return image;
}

using Tonemap = gpu_test::Test;

} // namespace

TEST_F(Tonemap, ClippedPictureIsTheExactSrgbCode)
{
    const cv::Mat4f linear = ramp();
    const cv::Mat4b encoded = encode(linear, 0, passes::Highlights::Clip);
    for (int y = 0; y < linear.rows; ++y)
        for (int x = 0; x < linear.cols; ++x) {
            const cv::Vec4f in = linear(y, x);
            const cv::Vec3b expected = base::srgb8_from_linear({in[0], in[1], in[2]});
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(encoded(y, x)[c], expected[c], 1)
                    << x; // a value halfway between codes may round either way
            EXPECT_EQ(encoded(y, x)[3], 255);
        }
}

// The shader's curve is a fit; only a value within .01 of halfway between two codes may get the other one.
TEST_F(Tonemap, EveryHalfFloatUpToOneGetsItsSrgbCode)
{
    constexpr int one = 0x3c00; // the bits of 1 as a half float
    cv::Mat1w bits(1, one + 1);
    for (int i = 0; i <= one; ++i)
        bits(0, i) = static_cast<ushort>(i);
    cv::Mat1f values;
    cv::Mat(bits.size(), CV_16F, bits.data).convertTo(values, CV_32F);
    cv::Mat4f linear;
    cv::merge(std::vector<cv::Mat>{values, values, values, cv::Mat1f(values.size(), 1.f)}, linear);
    const cv::Mat4b encoded = encode(linear, 0, passes::Highlights::Clip);
    int others = 0;
    for (int i = 0; i <= one; ++i) {
        const double code = 255 * base::srgb_from_linear(double(values(0, i)));
        EXPECT_NEAR(encoded(0, i)[0], code, .511) << values(0, i);
        others += encoded(0, i)[0] != std::lround(code);
    }
    EXPECT_LT(others, .01 * one);
}

TEST_F(Tonemap, ExposureIsInStops)
{
    cv::Mat4f linear(1, 1, cv::Vec4f(0.1f, 0.2f, 0.3f, 1));
    const cv::Vec4b code = encode(linear, 1, passes::Highlights::Clip)(0, 0);
    const cv::Vec3b expected = base::srgb8_from_linear({0.2, 0.4, 0.6});
    EXPECT_EQ(cv::Vec3b(code[0], code[1], code[2]), expected);
}

TEST_F(Tonemap, ShoulderKeepsSkinUnchangedAndHighlightsDistinct)
{
    cv::Mat4f linear(1, 3);
    linear(0, 0) = cv::Vec4f(0.6f, 0.4f, 0.3f, 1);
    linear(0, 1) = cv::Vec4f(1.0f, 1.0f, 1.0f, 1);
    linear(0, 2) = cv::Vec4f(1.3f, 1.3f, 1.3f, 1);
    const cv::Mat4b soft = encode(linear, 0, passes::Highlights::SoftShoulder);
    const cv::Mat4b clipped = encode(linear, 0, passes::Highlights::Clip);
    EXPECT_EQ(soft(0, 0), clipped(0, 0));
    EXPECT_LT(soft(0, 1)[0], soft(0, 2)[0]);
    EXPECT_EQ(clipped(0, 1), clipped(0, 2));
}

TEST_F(Tonemap, InvalidColorsBecomeBlackOrWhite)
{
    cv::Mat4f linear(1, 3);
    linear(0, 0) = cv::Vec4f(-1, -1e30f, -0.0f, 1);
    linear(0, 1) = cv::Vec4f(INFINITY, 3e38f, 65504, 1);
    linear(0, 2) = cv::Vec4f(-INFINITY, 0, 0, 1);
    const cv::Mat4b encoded = encode(linear, 3, passes::Highlights::SoftShoulder);
    EXPECT_EQ(encoded(0, 0), cv::Vec4b(0, 0, 0, 255));
    EXPECT_EQ(encoded(0, 1), cv::Vec4b(255, 255, 255, 255));
    EXPECT_EQ(encoded(0, 2), cv::Vec4b(0, 0, 0, 255));
}

// What the path tracer's pictures are encoded with, which see no graphics device.
TEST_F(Tonemap, IsThatOfTheCpu)
{
    cv::Mat4f linear(61, 47);
    for (int y = 0; y < linear.rows; ++y)
        for (int x = 0; x < linear.cols; ++x) {
            const float alpha = static_cast<float>(y) / 60, v = 1.5f * alpha * static_cast<float>(x) / 46;
            linear(y, x) = {v, v * v, 0.05f * v, alpha}; // premultiplied
        }
    for (const float stops : {-1.5f, 0.0f, 1.0f}) {
        const cv::Mat4b shader = encode(linear, stops, passes::Highlights::SoftShoulder,
                                        passes::backdrop_of(passes::ViewportTile({47, 61})));
        const cv::Mat3b cpu = base::encode_picture(linear, stops);
        for (int y = 0; y < linear.rows; ++y)
            for (int x = 0; x < linear.cols; ++x)
                for (int c = 0; c < 3; ++c) // a value halfway between codes may round either way
                    EXPECT_NEAR(shader(y, x)[c], cpu(y, x)[c], 1) << x << ", " << y << ", " << stops;
    }
}
