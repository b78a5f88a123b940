#include "stage/truth_error.hpp"

#include <gtest/gtest.h>

namespace {

TEST(RegionError, CountsTheRegionOnly)
{
    stage::PixelErrors errors{cv::Mat1f(10, 100, 1.f), cv::Mat1f(10, 100, .5f),
                              cv::Mat3f(10, 100, cv::Vec3f(1, -2, 3))};
    cv::Mat1b region(10, 100, uchar(0));
    EXPECT_EQ(stage::error_in(region, errors).pixels, 0u);
    region.row(0).setTo(255);
    errors.de.row(0).colRange(0, 10).setTo(5);
    errors.de(0, 99) = 9;
    errors.de.row(1).setTo(100);
    const stage::RegionError error = stage::error_in(region, errors);
    EXPECT_EQ(error.pixels, 100u);
    EXPECT_NEAR(error.mean, (89 + 50 + 9) / 100., 1e-6);
    EXPECT_EQ(error.p95, 5);
    EXPECT_EQ(error.max, 9);
    EXPECT_EQ(error.noise, .5);
    EXPECT_EQ(error.a, -2);
}

} // namespace
