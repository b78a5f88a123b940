// Mip levels on the CPU, and what a shader reads from a texture.
#include "engine/gpu/texture.hpp"
#include "tests/support/gpu.hpp"

#include <glm/glm.hpp>

namespace {

TEST(MipChain, GoesDownToOneTexelThroughOddSizes)
{
    const std::vector<cv::Mat> levels =
        gpu::mip_chain(cv::Mat(5, 12, CV_8UC4, cv::Scalar::all(10)), gpu::Encoding::Linear);
    ASSERT_EQ(levels.size(), 4u);
    EXPECT_EQ(levels[1].size(), cv::Size(6, 2));
    EXPECT_EQ(levels[2].size(), cv::Size(3, 1));
    EXPECT_EQ(levels[3].size(), cv::Size(1, 1));
    EXPECT_EQ(levels[3].at<cv::Vec4b>(0, 0), cv::Vec4b::all(10));
}

TEST(MipChain, AveragesColourInLinearLightAndAlphaUnconverted)
{
    cv::Mat4b checks(2, 2, cv::Vec4b(0, 0, 0, 0));
    checks(0, 0) = checks(1, 1) = cv::Vec4b(255, 255, 255, 255);
    // Half the light of white is 188 in sRGB, not 128.
    EXPECT_EQ(gpu::mip_chain(checks, gpu::Encoding::Srgb)[1].at<cv::Vec4b>(0, 0),
              cv::Vec4b(188, 188, 188, 128));
    EXPECT_EQ(gpu::mip_chain(checks, gpu::Encoding::Linear)[1].at<cv::Vec4b>(0, 0),
              cv::Vec4b(128, 128, 128, 128));
}

TEST(MipChain, KeepsEverySrgbValueOfAFlatPicture)
{
    for (int value = 0; value < 256; ++value) {
        const cv::Mat flat(2, 2, CV_8UC4, cv::Scalar::all(value));
        ASSERT_EQ(gpu::mip_chain(flat, gpu::Encoding::Srgb)[1].at<cv::Vec4b>(0, 0),
                  cv::Vec4b::all(static_cast<uchar>(value)));
    }
}

using TextureTest = gpu_test::Test;

/// What a shader reads from a texture, texel by texel.
cv::Mat4f sampled(const cv::Mat& picture, gpu::Encoding encoding)
{
    const gpu::Texture texture(gpu_test::device(), picture, encoding, false, "picture");
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    const graph::ImageDesc desc{static_cast<std::uint32_t>(picture.cols),
                                static_cast<std::uint32_t>(picture.rows), VK_FORMAT_R32G32B32A32_SFLOAT};
    const graph::ImageId shown = graph.image("shown", desc);
    graph::RasterPass& show = graph.raster("show");
    show.color(shown, {});
    show.sample("source", graph.import("picture", texture), graph::Sampler::NearestClamp);
    show.uniform("Tint", glm::vec4(1.0f));
    show.draw("test_quad").index_count = 3;
    const graph::ReadbackId back = graph.readback("shown", shown);
    return executor.run(graph).mat(back).clone();
}

TEST_F(TextureTest, SrgbColourReachesTheShaderAsLinearLight)
{
    cv::Mat4b ramp(1, 256);
    for (int i = 0; i < 256; ++i)
        ramp(0, i) = cv::Vec4b(static_cast<uchar>(i), static_cast<uchar>(255 - i), 0, static_cast<uchar>(i));
    const cv::Mat4f got = sampled(ramp, gpu::Encoding::Srgb);
    for (int i = 0; i < 256; ++i) {
        const double encoded = i / 255.0;
        const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        // llvmpipe decodes with a polynomial that is up to
        // 0.0012 off, a third of a step of the 8-bit picture.
        EXPECT_NEAR(got(0, i)[0], linear, 0.0013) << i;
        EXPECT_NEAR(got(0, i)[3], encoded, 1e-6) << i;
    }
}

TEST_F(TextureTest, EveryPixelTypeReachesTheShaderUnchanged)
{
    cv::Mat4f expected(3, 5);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x)
            expected(y, x) = cv::Vec4f(float(x) / 4, float(y) / 2, 0.25f, 0.5f);
    for (const int depth : {CV_8U, CV_16F, CV_32F})
        for (const int channels : {1, 2, 4}) {
            std::vector<cv::Mat> planes;
            cv::split(expected, planes);
            planes.resize(static_cast<std::size_t>(channels));
            cv::Mat picture;
            cv::merge(planes, picture);
            picture.convertTo(picture, depth, depth == CV_8U ? 255.0 : 1.0);
            const cv::Mat4f got = sampled(picture, gpu::Encoding::Linear);
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < 5; ++x)
                    for (int c = 0; c < channels; ++c)
                        EXPECT_NEAR(got(y, x)[c], expected(y, x)[c], depth == CV_8U ? 0.003 : 0.0)
                            << "depth " << depth << ", channels " << channels;
        }
}

TEST_F(TextureTest, APartOfALargerPictureIsUploadedWithoutItsSurroundings)
{
    cv::Mat4f whole(8, 8, cv::Vec4f::all(-1.0f));
    whole(cv::Rect(2, 3, 4, 2)).setTo(cv::Scalar::all(0.5));
    const cv::Mat4f got = sampled(whole(cv::Rect(2, 3, 4, 2)), gpu::Encoding::Linear);
    EXPECT_EQ(cv::countNonZero(got.reshape(1) != 0.5f), 0);
}

TEST_F(TextureTest, RefusesPixelsItHasNoFormatFor)
{
    EXPECT_THROW(gpu::Texture(gpu_test::device(), cv::Mat3b(4, 4), gpu::Encoding::Linear, false, "rgb"),
                 std::logic_error);
    EXPECT_THROW(gpu::Texture(gpu_test::device(), cv::Mat1b(4, 4), gpu::Encoding::Srgb, false, "grey"),
                 std::logic_error);
    EXPECT_THROW(gpu::Texture(gpu_test::device(), cv::Mat(), gpu::Encoding::Linear, false, "nothing"),
                 std::logic_error);
}

} // namespace
