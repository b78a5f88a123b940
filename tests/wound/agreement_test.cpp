// Comparison of predicted with observed masks.
#include "wound/photo/agreement.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/support/wound_photographs.hpp"
#include "wound/photo/segmentation.hpp"
#include "wound/prepare.hpp"

namespace {

TEST(Agreement, PredictionOfDayZeroIsTheMaskItself)
{
    const auto photo = testing_wounds::photograph({240, 200}, {110, 95}, testing_wounds::ellipse(50, 35));
    const auto wound = wound::prepare(photo, {});
    EXPECT_GT(wound::intersection_over_union(wound::predicted_mask(wound, 1), photo.mask), .97);
    const cv::Mat1b smaller = wound::predicted_mask(wound, .25);
    EXPECT_NEAR(cv::countNonZero(smaller), .25 * cv::countNonZero(photo.mask),
                .03 * cv::countNonZero(photo.mask));
}

TEST(Agreement, IgnoresPositionAndMeasuresSize)
{
    cv::Mat1b a = cv::Mat1b::zeros(100, 100), b = cv::Mat1b::zeros(80, 140), c = a.clone();
    cv::circle(a, {30, 30}, 20, 255, cv::FILLED);
    cv::circle(b, {100, 40}, 20, 255, cv::FILLED);
    cv::circle(c, {50, 50}, 25, 255, cv::FILLED);
    EXPECT_EQ(wound::agreement(a, b).intersection_over_union, 1);
    EXPECT_EQ(wound::agreement(a, b).border_distance_px, 0);
    EXPECT_NEAR(wound::agreement(a, c).area_ratio, .64, .02);
    EXPECT_NEAR(wound::agreement(a, c).border_distance_px, 5, .5);
}

} // namespace
