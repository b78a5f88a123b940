// Filtering of float images: values on texel centres, between them, beyond the edges and between mip levels.
#include <gtest/gtest.h>

#include "base/sampling.hpp"

namespace {

/// 4 x 2 texels; the second channel is the negative of the first.
cv::Mat2f ramp()
{
    cv::Mat2f image(2, 4);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x)
            image(y, x) = cv::Vec2f(float(x + 10 * y), -float(x + 10 * y));
    return image;
}

double at(double u, double v)
{
    const cv::Vec2d value = base::sample<2>(ramp(), {u, v});
    EXPECT_EQ(value[0], -value[1]);
    return value[0];
}

} // namespace

TEST(Sampling, ReturnsTexelsAtTheirCentresAndIsLinearBetween)
{
    EXPECT_DOUBLE_EQ(at(.125, .25), 0);
    EXPECT_DOUBLE_EQ(at(.875, .75), 13);
    EXPECT_DOUBLE_EQ(at(.5, .25), 1.5);
    EXPECT_DOUBLE_EQ(at(.5, .5), 6.5);
}

TEST(Sampling, ClampsToTheEdge)
{
    EXPECT_DOUBLE_EQ(at(-3, -1e30), 0);
    EXPECT_DOUBLE_EQ(at(1, 1), 13);
    EXPECT_DOUBLE_EQ(at(1e30, .25), 3);
}

TEST(Sampling, EveryLevelHasTheSameMeanAndTheLastIsOneTexel)
{
    const std::vector<cv::Mat> levels = base::mip_levels(ramp());
    ASSERT_EQ(levels.size(), 3u);
    EXPECT_EQ(levels[1].size(), cv::Size(2, 1));
    EXPECT_EQ(levels[2].size(), cv::Size(1, 1));
    for (const cv::Mat& level : levels)
        EXPECT_NEAR(cv::mean(level)[0], 6.5, 1e-6);
}

TEST(Sampling, InterpolatesBetweenLevelsAndClampsToTheLast)
{
    const std::vector<cv::Mat> levels = base::mip_levels(ramp());
    const auto at_lod = [&](double lod) { return base::sample<2>(levels, {.125, .25}, lod)[0]; };
    EXPECT_DOUBLE_EQ(at_lod(-1), 0);
    EXPECT_DOUBLE_EQ(at_lod(0), 0);
    EXPECT_DOUBLE_EQ(at_lod(.5), 2.75);
    EXPECT_DOUBLE_EQ(at_lod(1), 5.5); // mean of 0, 1, 10, 11
    EXPECT_DOUBLE_EQ(at_lod(99), 6.5);
}
