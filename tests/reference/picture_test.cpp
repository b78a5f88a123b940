// A picture's means, errors and noise, from samples whose statistics are known.
#include "reference/picture.hpp"

#include <gtest/gtest.h>
#include <random>

#include "base/tone_curve.hpp"

namespace {

using reference::Picture;
using reference::PixelSums;

/// Adds a pass of grey samples with this mean and deviation to every pixel.
void add_pass(Picture& picture, float mean, float deviation, std::mt19937& random)
{
    std::normal_distribution<float> light(mean, deviation);
    for (int y = 0; y < picture.size().height; ++y)
        for (int x = 0; x < picture.size().width; ++x) {
            PixelSums& sums = picture.sums(x, y);
            for (std::uint32_t i = 0; i < reference::samples_per_pass; ++i) {
                const float value = light(random);
                sums.diffuse += cv::Vec3f::all(value);
                sums.diffuse_squares += cv::Vec3f::all(value * value);
                sums.alpha += 1;
                if (picture.passes() % 2 == 0)
                    sums.first_half += cv::Vec3f::all(value);
            }
        }
    picture.set_passes(picture.passes() + 1);
}

Picture made(std::uint32_t passes, unsigned seed)
{
    Picture picture({40, 30});
    std::mt19937 random(seed);
    for (std::uint32_t i = 0; i < passes; ++i)
        add_pass(picture, .3f, .05f, random);
    return picture;
}

TEST(Picture, KnowsItsMeanAndItsError)
{
    const Picture picture = made(16, 1);
    EXPECT_EQ(picture.samples(), 64u);
    const cv::Mat4f radiance = picture.radiance();
    EXPECT_NEAR(cv::mean(radiance)[0], .3, .001);
    EXPECT_EQ(radiance(3, 3)[3], 1);
    EXPECT_NEAR(cv::mean(picture.diffuse_error())[0], .05 / 8, .0002);
    EXPECT_EQ(cv::mean(picture.specular_error())[0], 0);
}

// The number that is told of one picture is what two of them really differ by.
TEST(Picture, TellsByHowMuchTwoOfItWouldDiffer)
{
    for (const std::uint32_t passes : {2u, 5u, 16u}) {
        const Picture one = made(passes, 1), other = made(passes, 2);
        const cv::Mat4f a = one.radiance(), b = other.radiance();
        double sum = 0;
        for (int y = 0; y < a.rows; ++y)
            for (int x = 0; x < a.cols; ++x)
                sum +=
                    base::delta_e2000(base::lab_from_linear(cv::Vec3d(a(y, x)[0], a(y, x)[1], a(y, x)[2])),
                                      base::lab_from_linear(cv::Vec3d(b(y, x)[0], b(y, x)[1], b(y, x)[2])));
        const double real = sum / double(a.total());
        EXPECT_NEAR(one.noise_de(0), real, .1 * real) << passes << " passes";
    }
}

TEST(Picture, OfNothingHasNoNoise)
{
    Picture empty({8, 8});
    EXPECT_TRUE(std::isinf(empty.noise_de(0)));
    empty.set_passes(2);
    EXPECT_EQ(empty.noise_de(0), 0);
}

} // namespace
