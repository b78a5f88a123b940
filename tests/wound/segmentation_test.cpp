// Segmentation of synthetic photographs with known masks, hints, and masks given by the user.
#include "wound/photo/segmentation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "base/input_error.hpp"
#include "tests/support/wound_photographs.hpp"

namespace {

using testing::HasSubstr;
using testing_wounds::ellipse;
using testing_wounds::photograph;

template <typename Action>
std::string refusal(Action action)
{
    try {
        action();
    } catch (const base::InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Segmentation, FindsAWoundInTheMiddleWithoutHints)
{
    const auto photo = photograph({320, 240}, {165, 118}, ellipse(60, 42));
    const cv::Mat1b mask = wound::segment(photo.srgb, {}, "photo.png");
    EXPECT_EQ(mask.size(), photo.srgb.size());
    EXPECT_GT(wound::intersection_over_union(mask, photo.mask), .95);
}

TEST(Segmentation, SeedAndRectangleFindAWoundOffTheMiddle)
{
    const auto photo = photograph({320, 240}, {240, 70}, ellipse(30, 36));
    wound::SegmentationHints by_seed, by_rect;
    by_seed.seed = cv::Point(238, 75);
    by_rect.rect = cv::Rect(200, 25, 80, 90);
    EXPECT_GT(wound::intersection_over_union(wound::segment(photo.srgb, by_seed, "p"), photo.mask), .93);
    EXPECT_GT(wound::intersection_over_union(wound::segment(photo.srgb, by_rect, "p"), photo.mask), .95);
}

TEST(Segmentation, TurningMirroringAndScalingThePhotographDoesTheSameToTheMask)
{
    const auto photo = photograph({240, 200}, {110, 104}, ellipse(44, 28));
    const cv::Mat1b found = wound::segment(photo.srgb, {}, "photo");
    cv::Mat turned, mirrored, expected;
    cv::rotate(photo.srgb, turned, cv::ROTATE_90_CLOCKWISE);
    cv::rotate(found, expected, cv::ROTATE_90_CLOCKWISE);
    EXPECT_GT(wound::intersection_over_union(wound::segment(turned, {}, "photo"), expected), .96);
    cv::flip(photo.srgb, mirrored, 1);
    cv::flip(found, expected, 1);
    EXPECT_GT(wound::intersection_over_union(wound::segment(mirrored, {}, "photo"), expected), .96);
    cv::Mat doubled;
    cv::resize(photo.srgb, doubled, {}, 2, 2, cv::INTER_NEAREST);
    cv::resize(found, expected, {}, 2, 2, cv::INTER_NEAREST);
    EXPECT_GT(wound::intersection_over_union(wound::segment(doubled, {}, "photo"), expected), .96);
}

TEST(Segmentation, IsDeterministic)
{
    const auto photo = photograph({200, 200}, {100, 100}, ellipse(45, 35));
    wound::SegmentationHints hints;
    hints.rect = cv::Rect(40, 50, 120, 100);
    const cv::Mat1b first = wound::segment(photo.srgb, hints, "p");
    EXPECT_EQ(cv::countNonZero(first != wound::segment(photo.srgb, hints, "p")), 0);
}

TEST(Segmentation, LargePhotographsAreMappedBack)
{
    const auto photo = photograph({1800, 1400}, {1000, 800}, ellipse(260, 330));
    wound::SegmentationHints hints;
    hints.rect = cv::Rect(660, 400, 680, 800);
    const cv::Mat1b mask = wound::segment(photo.srgb, hints, "p");
    EXPECT_GT(wound::intersection_over_union(mask, photo.mask), .96);
}

TEST(Segmentation, BlackSurroundingsOfACircularCropAreNoPartOfThePicture)
{
    auto photo = photograph({300, 300}, {150, 150}, ellipse(40, 40));
    cv::Mat1b crop = cv::Mat1b::zeros(photo.srgb.size());
    cv::circle(crop, {150, 150}, 140, 255, cv::FILLED);
    photo.srgb.setTo(0, crop == 0);
    EXPECT_GT(cv::countNonZero(wound::picture_area(photo.srgb) == crop), .99 * 300 * 300);
    EXPECT_GT(wound::intersection_over_union(wound::segment(photo.srgb, {}, "p"), photo.mask), .93);
}

TEST(Segmentation, PhotographWithoutAWoundIsRefused)
{
    const auto skin = photograph({200, 160}, {0, 0}, [](double, double) { return 2.; });
    EXPECT_THAT(refusal([&] { wound::segment(skin.srgb, {}, "skin.png"); }),
                HasSubstr("skin.png: no wound found"));
    const cv::Mat3b black(100, 100, cv::Vec3b(0, 0, 0));
    EXPECT_THAT(refusal([&] { wound::segment(black, {}, "black.png"); }), HasSubstr("black"));
    const cv::Mat3b speck(1, 1, cv::Vec3b(9, 9, 200));
    EXPECT_THAT(refusal([&] { wound::segment(speck, {}, "speck.png"); }), HasSubstr("1x1"));
}

TEST(Segmentation, HintsOutsideThePhotographAreRefused)
{
    const auto photo = photograph({200, 160}, {100, 80}, ellipse(30, 30));
    wound::SegmentationHints hints;
    hints.seed = cv::Point(500, 10);
    EXPECT_THAT(refusal([&] { wound::segment(photo.srgb, hints, "p"); }), HasSubstr("seed"));
    hints = {};
    hints.rect = cv::Rect(150, 100, 100, 100);
    EXPECT_THAT(refusal([&] { wound::segment(photo.srgb, hints, "p"); }), HasSubstr("rectangle"));
}

TEST(Mask, EmptyAndWrongSizeAreRefused)
{
    const cv::Size size(60, 40);
    const auto reason = [&](const cv::Mat1b& mask) {
        return refusal([&] { wound::checked_mask(mask, size, "mask.png"); });
    };
    EXPECT_THAT(reason(cv::Mat1b::zeros(40, 60)), HasSubstr("mask.png: the mask is empty"));
    EXPECT_THAT(reason(cv::Mat1b::zeros(41, 60)), HasSubstr("60x41"));
}

TEST(Mask, AFullMaskIsTheWholePhotographUnlessThatIsTiny)
{
    const cv::Mat1b full(40, 60, uchar(255)), line(1, 200, uchar(255));
    EXPECT_EQ(cv::countNonZero(wound::checked_mask(full, full.size(), "m")), 40 * 60);
    EXPECT_THAT(refusal([&] { wound::checked_mask(line, line.size(), "line.png"); }),
                HasSubstr("line.png: 200x1 pixels"));
}

TEST(Mask, LargestComponentIsTakenAndHolesAreFilled)
{
    cv::Mat1b mask = cv::Mat1b::zeros(80, 80);
    cv::circle(mask, {50, 50}, 15, 255, cv::FILLED);
    cv::circle(mask, {50, 50}, 5, 0, cv::FILLED);
    cv::circle(mask, {10, 10}, 4, 255, cv::FILLED);
    cv::Mat1b expected = cv::Mat1b::zeros(80, 80);
    cv::circle(expected, {50, 50}, 15, 255, cv::FILLED);
    EXPECT_EQ(cv::countNonZero(wound::checked_mask(mask, mask.size(), "m") != expected), 0);
    const auto parts = wound::components(mask, 9);
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_GT(cv::countNonZero(parts[0]), cv::countNonZero(parts[1]));
}

TEST(Mask, IntersectionOverUnion)
{
    cv::Mat1b a = cv::Mat1b::zeros(10, 10), b = a.clone();
    EXPECT_EQ(wound::intersection_over_union(a, b), 1);
    a(cv::Rect(0, 0, 4, 4)).setTo(255);
    b(cv::Rect(2, 0, 4, 4)).setTo(255);
    EXPECT_DOUBLE_EQ(wound::intersection_over_union(a, b), 8. / 24);
}

} // namespace
