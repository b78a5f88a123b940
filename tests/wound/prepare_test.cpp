// From a synthetic photograph to any day: invariants of the whole pipeline.
#include "wound/prepare.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "base/color.hpp"
#include "base/input_error.hpp"
#include "tests/support/wound_photographs.hpp"
#include "wound/contour.hpp"
#include "wound/photo/healthy_skin.hpp"

namespace {

using testing_wounds::photograph;

/// Neither symmetric nor convex.
double bean(double dx, double dy)
{
    const double angle = std::atan2(dy, dx);
    return std::hypot(dx, dy) / (46 + 11 * std::cos(2 * angle + .4) + 6 * std::sin(3 * angle));
}

wound::Preparation small_patch()
{
    wound::Preparation preparation;
    preparation.patch_size = 256;
    return preparation;
}

TEST(Prepare, CentresTheWoundAndScalesItToItsWidth)
{
    const auto photo = photograph({260, 220}, {120, 110}, bean);
    const auto wound = wound::prepare(photo, small_patch());
    EXPECT_LT(cv::norm(wound.centroid), 1e-3);
    const cv::Rect bounds = cv::boundingRect(wound.patch.mask > .5F);
    EXPECT_NEAR(std::max(bounds.width, bounds.height), .45 * 256, 2.5);
    EXPECT_NEAR(wound.patch.width_mm * .45, 30, 1e-9);
    const double pixels_per_patch =
        std::max(cv::boundingRect(photo.mask).width, cv::boundingRect(photo.mask).height) / .45;
    EXPECT_NEAR(wound.area * pixels_per_patch * pixels_per_patch / 4, cv::countNonZero(photo.mask),
                .01 * cv::countNonZero(photo.mask));
    EXPECT_GE(wound.control_points.size(), 8U);
    EXPECT_LE(wound.control_points.size(), 512U);
    EXPECT_NEAR(wound::signed_area(wound.border), wound.area, .01 * wound.area);
}

TEST(Prepare, MapsHaveTheirRangesAndTheOpacityFallsToZeroInside)
{
    const auto wound = wound::prepare(photograph({260, 220}, {120, 110}, bean), small_patch());
    for (const cv::Mat& map :
         {cv::Mat(wound.patch.color), cv::Mat(wound.patch.opacity), cv::Mat(wound.patch.mask)})
    {
        EXPECT_TRUE(cv::checkRange(map, true, nullptr, -1e-6, 1 + 1e-6));
        EXPECT_EQ(map.size(), cv::Size(256, 256));
    }
    EXPECT_TRUE(cv::checkRange(wound.patch.depth_mm));
    EXPECT_EQ(cv::countNonZero(wound.patch.opacity.row(2) > 1e-4F), 0);
    EXPECT_GT(wound.patch.opacity(128, 128), .99F);
}

TEST(Prepare, RotatingAndMirroringThePhotographDoesTheSameToTheResult)
{
    const auto photo = photograph({240, 240}, {119.5, 119.5}, bean);
    const auto base = wound::prepare(photo, small_patch());
    for (int turn : {int(cv::ROTATE_90_CLOCKWISE), int(cv::ROTATE_180), -1}) {
        wound::Photograph moved;
        const auto move = [turn](const cv::Mat& from, auto& to) {
            turn < 0 ? cv::flip(from, to, 1) : cv::rotate(from, to, turn);
        };
        move(photo.srgb, moved.srgb);
        move(photo.mask, moved.mask);
        const auto wound = wound::prepare(moved, small_patch());
        EXPECT_NEAR(wound.area, base.area, 1e-3 * base.area);
        EXPECT_EQ(wound.control_points.size(), base.control_points.size());
        cv::Mat1f expected;
        move(base.patch.mask, expected);
        EXPECT_LT(cv::norm(wound.patch.mask, expected, cv::NORM_L1) / cv::sum(expected)[0], .01);
        move(base.patch.depth_mm, expected);
        EXPECT_LT(cv::norm(wound.patch.depth_mm, expected, cv::NORM_L1) / cv::norm(expected, cv::NORM_L1),
                  .05);
    }
}

TEST(Prepare, ScalingThePhotographChangesNothing)
{
    const auto photo = photograph({240, 240}, {120, 120}, bean);
    wound::Photograph doubled;
    cv::resize(photo.srgb, doubled.srgb, {}, 2, 2, cv::INTER_NEAREST);
    cv::resize(photo.mask, doubled.mask, {}, 2, 2, cv::INTER_NEAREST);
    const auto a = wound::prepare(photo, small_patch()), b = wound::prepare(doubled, small_patch());
    EXPECT_NEAR(a.area, b.area, .01 * a.area);
    EXPECT_LT(cv::norm(a.patch.mask, b.patch.mask, cv::NORM_L1) / cv::sum(a.patch.mask)[0], .02);
}

TEST(Prepare, APhotographFarFinerThanThePatchGivesTheSamePatch)
{
    const auto photo = photograph({240, 240}, {120, 120}, bean);
    wound::Photograph fine;
    cv::resize(photo.srgb, fine.srgb, {}, 6, 6, cv::INTER_NEAREST);
    cv::resize(photo.mask, fine.mask, {}, 6, 6, cv::INTER_NEAREST);
    wound::Preparation preparation;
    preparation.patch_size = 128;
    const auto a = wound::prepare(photo, preparation), b = wound::prepare(fine, preparation);
    EXPECT_LT(cv::norm(a.patch.mask, b.patch.mask, cv::NORM_L1) / cv::sum(a.patch.mask)[0], .02);
    EXPECT_LT(cv::norm(a.patch.color, b.patch.color, cv::NORM_INF), .2);
    EXPECT_NEAR(b.photo_side, 6 * a.photo_side, 6);
}

TEST(Prepare, SeveralComponentsBecomeSeveralWoundsAtOneScale)
{
    auto photo = photograph({300, 200}, {90, 100}, testing_wounds::ellipse(45, 45));
    cv::circle(photo.mask, {230, 100}, 15, 255, cv::FILLED);
    const auto wounds = wound::prepare_all(photo, small_patch());
    ASSERT_EQ(wounds.size(), 2U);
    EXPECT_NEAR(wounds[0].photo_center.x, 90, .5);
    EXPECT_NEAR(wounds[1].photo_center.x, 230, .5);
    EXPECT_NEAR(wounds[0].patch.width_mm / wounds[0].photo_side,
                wounds[1].patch.width_mm / wounds[1].photo_side, 1e-9);
    photo.mask.setTo(0);
    EXPECT_THROW(wound::prepare_all(photo, small_patch()), base::InputError);
}

TEST(Prepare, AOnePixelWoundAndOneThatNearlyFillsThePhotographWork)
{
    auto photo = photograph({64, 64}, {32, 32}, [](double, double) { return 2.; });
    photo.mask(30, 20) = 255;
    const auto speck = wound::prepare(photo, small_patch());
    EXPECT_GE(speck.control_points.size(), 8U);
    const double pixel = 2 / speck.photo_side; // in patch units
    EXPECT_NEAR(speck.area, pixel * pixel, .5 * pixel * pixel);
    for (double r : {1.4, .6, .2, .05})
        EXPECT_EQ(wound::check_folds(wound::make_warp(speck.flow, r), 256).folded_texels, 0) << r;
    photo.mask(cv::Rect(12, 30, 40, 1)).setTo(255);
    const auto line = wound::prepare(photo, small_patch());
    EXPECT_NEAR(line.area * line.photo_side * line.photo_side / 4, 40, 16);
    EXPECT_EQ(wound::check_folds(wound::make_warp(line.flow, .05), 256).folded_texels, 0);
    photo.mask.setTo(0);
    for (int i = 12; i < 52; ++i) // pixels that touch at their corners only
        photo.mask(i, i) = 255;
    const auto diagonal = wound::prepare(photo, small_patch());
    EXPECT_NEAR(wound::signed_area(diagonal.border), diagonal.area, .1 * diagonal.area);
    EXPECT_NEAR(diagonal.area * diagonal.photo_side * diagonal.photo_side / 4, 40, 16);
    photo.mask.setTo(0);
    photo.mask(cv::Rect(1, 1, 62, 62)).setTo(255);
    const auto filling = wound::prepare(photo, small_patch());
    EXPECT_EQ(wound::check_folds(wound::make_warp(filling.flow, .05), 256).folded_texels, 0);
    EXPECT_TRUE(cv::checkRange(filling.patch.color) && cv::checkRange(filling.patch.depth_mm));
}

// Half of the wound is in the picture: the edge of the picture is the wound's border, with skin beyond it.
TEST(Prepare, AWoundCutByThePhotographsEdgeEndsThereInSkin)
{
    const auto photo = photograph({200, 160}, {0, 80}, testing_wounds::ellipse(50, 40));
    ASSERT_GT(photo.mask(80, 0), 0);
    const auto wound = wound::prepare(photo, small_patch());
    EXPECT_NEAR(wound.area * wound.photo_side * wound.photo_side / 4, cv::countNonZero(photo.mask),
                .02 * cv::countNonZero(photo.mask));
    EXPECT_NEAR(wound.photo_center.x, 4 * 50 / (3 * CV_PI), 1.5); // of half an ellipse
    const auto texel = [&](double x) {
        return cv::Point(int((x - wound.photo_center.x) / wound.photo_side * 256 + 128), 128);
    };
    EXPECT_GT(wound.patch.opacity(texel(3)), .9F);
    EXPECT_LT(wound.patch.opacity(texel(-6)), .1F);
    const cv::Vec3f beyond = wound.patch.color(texel(-20)), skin = wound.patch.color(texel(95)),
                    bed = wound.patch.color(texel(20));
    EXPECT_LT(cv::norm(beyond - skin), .25 * cv::norm(bed - skin));
    for (double r : {1.4, .6, .2, .05, .01}) {
        const wound::Warp warp = wound::make_warp(wound.flow, r);
        EXPECT_EQ(wound::check_folds(warp, 256).folded_texels, 0) << r;
    }
}

/// A photograph with wound everywhere.
wound::Photograph filled(cv::Size size)
{
    return photograph(size, {size.width / 2., size.height / 2.}, [](double, double) { return 0.; });
}

// The edge of the photograph is the wound's border. No skin is visible, so average skin is used beyond it.
TEST(Prepare, AWoundThatFillsThePhotographEndsAtItsEdgeInAverageSkin)
{
    const auto wound = wound::prepare(filled({180, 120}), small_patch());
    EXPECT_FALSE(wound.patch.shows_skin);
    EXPECT_NEAR(wound.photo_side, 180 / wound::wound_share, 1e-9);
    EXPECT_NEAR(wound.area * wound.photo_side * wound.photo_side / 4, 180 * 120, .01 * 180 * 120);
    const double half = wound::wound_share, half_height = half * 120 / 180;
    for (cv::Point2d p : wound.border) // every point is on a side
        EXPECT_NEAR(std::max(std::abs(p.x) / half, std::abs(p.y) / half_height), 1, .03) << p;
    EXPECT_FLOAT_EQ(wound.patch.opacity(128, 128), 1);
    EXPECT_EQ(wound.patch.opacity(128, 40), 0);
    const base::Lab beyond = base::lab_from_linear(base::Color(wound.patch.color(128, 40)));
    EXPECT_LT(base::delta_e2000(beyond, wound::average_skin), .1);
    EXPECT_GT(wound.patch.depth_mm(128, 128), .5) << "red tissue lies deep compared with average skin";
    EXPECT_TRUE(cv::checkRange(wound.patch.color) && cv::checkRange(wound.patch.depth_mm));
    for (double r : {1.4, .6, .2, .05, .01}) {
        const wound::Warp warp = wound::make_warp(wound.flow, r);
        EXPECT_EQ(wound::check_folds(warp, 256).folded_texels, 0) << r;
        EXPECT_NEAR(wound::moments_of(wound::warp_image(wound.patch.mask, warp)).area / wound.area, r,
                    std::max(.02 * r, .002));
    }
}

TEST(Prepare, AWoundThatFillsAPictureOnBlackEndsWithThePicture)
{
    auto photo = filled({200, 200});
    cv::Mat1b disk = cv::Mat1b::zeros(200, 200);
    cv::circle(disk, {100, 100}, 90, 255, cv::FILLED);
    photo.srgb.setTo(cv::Scalar::all(0), ~disk);
    const auto wound = wound::prepare(photo, small_patch());
    EXPECT_FALSE(wound.patch.shows_skin);
    EXPECT_EQ(cv::countNonZero(wound.photo_mask != disk), 0);
    photo.srgb.setTo(cv::Scalar::all(0));
    EXPECT_THROW(wound::prepare(photo, small_patch()), base::InputError);
}

TEST(Prepare, WoundsThatFillThePhotographTogetherDoNotCountAsSkin)
{
    auto photo = filled({200, 120});
    photo.mask.col(110).setTo(0);
    const auto wounds = wound::prepare_all(photo, small_patch());
    ASSERT_EQ(wounds.size(), 2U);
    EXPECT_FALSE(wounds[0].patch.shows_skin);
    EXPECT_FALSE(wounds[1].patch.shows_skin);
    const auto apart = photograph({300, 200}, {90, 100}, testing_wounds::ellipse(45, 45));
    EXPECT_TRUE(wound::prepare(apart, small_patch()).patch.shows_skin);
}

TEST(Prepare, WarpedMaskHasTheAreaOfTheRatio)
{
    const auto wound = wound::prepare(photograph({260, 220}, {120, 110}, bean), small_patch());
    for (double r : {.9, .6, .4, .2, .1, .05}) {
        const cv::Mat warped = wound::warp_image(wound.patch.mask, wound::make_warp(wound.flow, r));
        const auto today = wound::moments_of(warped);
        EXPECT_NEAR(today.area / wound.area, r, std::min(.02 * r, .005));
        EXPECT_LT(cv::norm(today.centroid - wound.centroid), .01 * std::sqrt(r));
    }
}

TEST(Prepare, DayZeroIsTheWoundItselfAndLaterDaysShrinkIt)
{
    const auto wound = wound::prepare(photograph({260, 220}, {120, 110}, bean), small_patch());
    const wound::Healing face;
    const auto day0 = wound::wound_at(wound, face, 0);
    EXPECT_EQ(day0.unhealed_ratio, 1);
    EXPECT_LT(cv::norm(day0.bed_warp.apply({.3, .2}) - cv::Point2d(.3, .2)), 1e-6);
    double last = 1;
    for (double day : {4., 8., 16., 28.}) {
        const auto state = wound::wound_at(wound, face, day);
        EXPECT_LT(state.unhealed_ratio, last);
        EXPECT_GT(state.border_ratio, state.unhealed_ratio);
        EXPECT_DOUBLE_EQ(state.bed_warp.scale, std::sqrt(state.unhealed_ratio));
        EXPECT_DOUBLE_EQ(state.border_warp.scale, std::sqrt(state.border_ratio));
        last = state.unhealed_ratio;
    }
}

TEST(Prepare, TheLastOfTheBedFadesAfterClosure)
{
    const auto wound = wound::prepare(photograph({260, 220}, {120, 110}, bean), small_patch());
    const wound::Healing face;
    const double closed = wound::closure_day(face.curve);
    EXPECT_EQ(wound::wound_at(wound, face, closed - 1).bed_presence, 1);
    double last = 1, steepest = 0;
    for (double day = closed - 1; day < closed + 20; day += 1) {
        const auto today = wound::wound_at(wound, face, day, wound::WarpModel::Radial);
        steepest = std::max(steepest, last - today.bed_presence);
        EXPECT_LE(today.bed_presence, last);
        last = today.bed_presence;
    }
    EXPECT_EQ(last, 0);
    EXPECT_LT(steepest, .5);
}

/// Every number of a day that a frame depends on.
std::vector<std::pair<std::string, double>> numbers_of(const wound::WoundDay& day)
{
    return {{"unhealed ratio", day.unhealed_ratio},
            {"border ratio", day.border_ratio},
            {"recovery ratio", day.recovery_ratio},
            {"bed recovery", day.bed_recovery},
            {"border recovery", day.border_recovery},
            {"border softness", day.border_softness},
            {"depth scale", day.depth_scale},
            {"clot", day.phase.clot},
            {"fibrin", day.phase.fibrin},
            {"granulation", day.phase.granulation},
            {"rim", day.phase.rim},
            {"bed presence", day.bed_presence},
            {"redness", day.scar.redness},
            {"pigmentation", day.scar.pigmentation},
            {"height", day.scar.height_mm},
            {"sheen", day.scar.sheen},
            {"pore loss", day.scar.pore_loss},
            {"border scale", day.border_warp.scale},
            {"bed scale", day.bed_warp.scale}};
}

TEST(Prepare, NoNumberOfADayJumpsAtClosure)
{
    const auto wound = wound::prepare(photograph({260, 220}, {120, 110}, bean), small_patch());
    for (const auto model : {wound::HealingModel::Face, wound::HealingModel::Contraction}) {
        wound::Healing healing;
        healing.model = model;
        const double closed = wound::closure_day(healing.curve), instant = 1e-6;
        const auto at = [&](double day) {
            return numbers_of(wound::wound_at(wound, healing, day, wound::WarpModel::Radial));
        };
        const auto day_before = at(closed - 1), before = at(closed - instant), after = at(closed + instant),
                   day_after = at(closed + 1);
        for (std::size_t i = 0; i < day_before.size(); ++i) {
            const double a_day = std::max(std::abs(before[i].second - day_before[i].second),
                                          std::abs(day_after[i].second - after[i].second));
            EXPECT_LE(std::abs(after[i].second - before[i].second), 100 * 2 * instant * a_day + 1e-12)
                << day_before[i].first << (model == wound::HealingModel::Face ? ", face" : ", contraction");
        }
    }
}

TEST(Prepare, BadWidthsAndEmptyPhotographsAreRefused)
{
    auto preparation = small_patch();
    preparation.width_mm = std::nan("");
    const auto photo = photograph({64, 64}, {32, 32}, bean);
    EXPECT_THROW(wound::prepare(photo, preparation), base::InputError);
    EXPECT_THROW(wound::prepare({}, small_patch()), base::InputError);
}

} // namespace
