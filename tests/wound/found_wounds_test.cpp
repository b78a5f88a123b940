// Segmentation of photographs composed of generated wounds: none, one or several.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/input_error.hpp"
#include "tests/support/composed_photographs.hpp"
#include "wound/photo/segmentation.hpp"
#include "wound/prepare.hpp"

namespace {

using testing_wounds::compose;
using testing_wounds::PlacedWound;
using testing_wounds::Setting;

PlacedWound placed(const char* kind, std::uint32_t seed, cv::Point at, int side,
                   const cv::Vec3d& tint = {1, 1, 1})
{
    PlacedWound result{{}, at, side, tint};
    result.wound.kind = kind;
    result.wound.seed = seed;
    return result;
}

/// A red and a smaller, dark wound on skin that fills the picture.
wound::Photograph two_on_skin()
{
    return compose({}, {placed("abrasion", 11, {200, 240}, 280),
                        placed("avulsion", 12, {470, 120}, 160, {.75, .75, .75})});
}

Setting limb(const cv::Vec3b& background, const cv::Vec3b& skin = {212, 164, 140})
{
    Setting setting;
    setting.size = {480, 640};
    setting.background = background;
    setting.skin = skin;
    return setting;
}

std::vector<PlacedWound> three_along_a_limb()
{
    return {placed("abrasion", 21, {230, 330}, 220), placed("avulsion", 22, {260, 510}, 150, {.8, .8, .8}),
            placed("laceration", 23, {215, 130}, 200)};
}

/// As many wounds are found as drawn, and each drawn one overlaps a found one by more than `least` (IoU).
void expect_alike(const cv::Mat1b& found, const cv::Mat1b& drawn, double least)
{
    const auto parts = wound::components(found, 99), truth = wound::components(drawn, 99);
    ASSERT_EQ(parts.size(), truth.size());
    for (const cv::Mat1b& one : truth) {
        double best = 0;
        for (const cv::Mat1b& part : parts)
            best = std::max(best, wound::intersection_over_union(part, one));
        EXPECT_GT(best, least);
    }
}

cv::Rect around(const cv::Mat1b& mask)
{
    const cv::Rect bounds = cv::boundingRect(mask);
    const cv::Size margin(bounds.width / 10, bounds.height / 10);
    return bounds - cv::Point(margin) + margin + margin;
}

TEST(FoundWounds, AllOfAPhotographAreFoundWithoutHints)
{
    const auto two = two_on_skin();
    expect_alike(wound::segment(two.srgb, {}, "p"), two.mask, .7);
    for (const cv::Vec3b& background : {cv::Vec3b(18, 18, 20), {60, 110, 160}, {150, 40, 40}}) {
        const auto three = compose(limb(background), three_along_a_limb());
        expect_alike(wound::segment(three.srgb, {}, "p"), three.mask, .6);
    }
    const auto dark = compose(limb({225, 225, 222}, {105, 70, 52}), three_along_a_limb());
    expect_alike(wound::segment(dark.srgb, {}, "p"), dark.mask, .6);
}

TEST(FoundWounds, SkinAloneHasNone)
{
    for (const cv::Vec3b& background :
         {cv::Vec3b(18, 18, 20), {60, 110, 160}, {225, 225, 222}, {150, 110, 70}, {150, 40, 40}})
        for (const cv::Vec3b& skin : {cv::Vec3b(228, 190, 170), {170, 120, 90}, {105, 70, 52}})
            EXPECT_THROW(wound::segment(compose(limb(background, skin), {}).srgb, {}, "p"), base::InputError);
    EXPECT_THROW(wound::segment(compose({}, {}).srgb, {}, "p"), base::InputError);
}

TEST(FoundWounds, AGeneratedPhotographShowsOne)
{
    for (const std::string& kind : wound::kind_names())
        for (std::uint32_t seed : {1, 2, 3, 4}) {
            wound::SyntheticWound synthetic;
            synthetic.kind = kind;
            synthetic.seed = seed;
            const auto photo = wound::synthesize(synthetic);
            expect_alike(wound::segment(photo.srgb, {}, "p"), photo.mask, .7);
        }
}

TEST(FoundWounds, RectangleSelectsTheWoundsInsideIt)
{
    const auto photo = two_on_skin();
    wound::SegmentationHints hints;
    hints.rect = around(photo.mask);
    expect_alike(wound::segment(photo.srgb, hints, "p"), photo.mask, .7);
    for (const cv::Mat1b& one : wound::components(photo.mask, 2)) {
        hints.rect = around(one);
        expect_alike(wound::segment(photo.srgb, hints, "p"), one, .75);
    }
}

TEST(FoundWounds, SeedSelectsTheWoundItLiesIn)
{
    const auto photo = two_on_skin();
    for (const cv::Mat1b& one : wound::components(photo.mask, 2)) {
        const cv::Rect bounds = cv::boundingRect(one);
        wound::SegmentationHints hints;
        hints.seed = (bounds.tl() + bounds.br()) / 2;
        expect_alike(wound::segment(photo.srgb, hints, "p"), one, .7);
    }
}

TEST(FoundWounds, TurningAndMirroringThePhotographDoesTheSameToTheMask)
{
    const auto photo = two_on_skin();
    const cv::Mat1b found = wound::segment(photo.srgb, {}, "p");
    cv::Mat turned, expected;
    cv::rotate(photo.srgb, turned, cv::ROTATE_90_CLOCKWISE);
    cv::rotate(found, expected, cv::ROTATE_90_CLOCKWISE);
    EXPECT_GT(wound::intersection_over_union(wound::segment(turned, {}, "p"), expected), .93);
    cv::flip(photo.srgb, turned, 1);
    cv::flip(found, expected, 1);
    EXPECT_GT(wound::intersection_over_union(wound::segment(turned, {}, "p"), expected), .93);
}

TEST(FoundWounds, AreSeparatedLikeThoseOfAGivenMask)
{
    const auto photo = two_on_skin();
    const std::vector<wound::WoundPart> given = wound::separate(photo, {}),
                                        found = wound::separate({photo.srgb, {}, {}}, {});
    ASSERT_EQ(given.size(), 2U);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].width_mm, 30);
    EXPECT_NEAR(found[1].width_mm, given[1].width_mm, .15 * given[1].width_mm);
    EXPECT_LT(cv::norm(found[1].offset_mm - given[1].offset_mm), .05 * cv::norm(given[1].offset_mm));
    EXPECT_GT(wound::intersection_over_union(found[0].photograph.other_wounds, found[1].photograph.mask),
              .99);
    wound::Preparation preparation;
    preparation.patch_size = 64;
    EXPECT_EQ(wound::prepare_all({photo.srgb, {}, {}}, preparation).size(), 2U);
}

} // namespace
