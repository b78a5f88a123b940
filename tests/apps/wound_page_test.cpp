// The page and the numbers of `cicatrix wound`.
#include "apps/wound/wound_page.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/wound_photographs.hpp"
#include "wound/prepare.hpp"

namespace {

wound::Preparation small_patch()
{
    wound::Preparation preparation;
    preparation.patch_size = 128;
    return preparation;
}

TEST(WoundPage, NumbersAreInPixelsOfThePhotograph)
{
    const auto photo = testing_wounds::photograph({220, 180}, {120, 90}, testing_wounds::ellipse(40, 30));
    const auto json = wound_command::wound_to_json(wound::prepare(photo, small_patch()), {});
    EXPECT_NEAR(json["area_px"].get<double>(), cv::countNonZero(photo.mask),
                .02 * cv::countNonZero(photo.mask));
    EXPECT_NEAR(json["centroid_px"][0].get<double>(), 120, .1);
    EXPECT_NEAR(json["centroid_px"][1].get<double>(), 90, .1);
    EXPECT_EQ(json["folds"], 0);
    EXPECT_GE(json["control_points"].size(), 8U);
    for (const auto& p : json["control_points"])
        EXPECT_NEAR(std::pow((p[0].get<double>() - 120) / 40, 2) +
                        std::pow((p[1].get<double>() - 90) / 30, 2),
                    1, .06);
    EXPECT_GT(json["depth_mm_max"].get<double>(), .2);
    EXPECT_NEAR(json["half_time_days"].get<double>(), 8.45, .01);
    EXPECT_EQ(json["days"][0]["unhealed_ratio"], 1);
}

TEST(WoundPage, PageShowsThePhotographAndTheControlPoints)
{
    const auto photo = testing_wounds::photograph({220, 180}, {120, 90}, testing_wounds::ellipse(40, 30));
    const cv::Mat3b page = wound_command::draw_wound_page(photo, wound::prepare(photo, small_patch()), {});
    int red = 0;
    for (const cv::Vec3b& p : page)
        red += p == cv::Vec3b(200, 30, 30);
    EXPECT_GT(red, 500);
    EXPECT_GT(page.cols, 1200);
}

} // namespace
