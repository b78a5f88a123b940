// Tissue thickness over the face, layers from hue, and the depth map's shape.
#include "wound/depth.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "base/color.hpp"

namespace {

constexpr int map_size = 256;
constexpr double patch_width_mm = 60;
const cv::Vec3f skin_rgb{.52F, .33F, .25F}, blood_color{.28F, .04F, .03F}, fat{.75F, .55F, .15F};

cv::Vec3f lab(const cv::Vec3f& linear)
{
    return base::lab_from_linear(cv::Mat3f(1, 1, linear))(0, 0);
}

cv::Mat1f disk(double radius)
{
    cv::Mat1f mask = cv::Mat1f::zeros(map_size, map_size);
    cv::circle(mask, {map_size / 2, map_size / 2}, static_cast<int>(radius * map_size / 2), 1, cv::FILLED);
    return mask;
}

cv::Mat3f painted(const cv::Mat1f& mask, const cv::Vec3f& bed)
{
    cv::Mat3f color(mask.size(), skin_rgb);
    color.setTo(bed, mask > .5F);
    return color;
}

TEST(Tissue, ThicknessFollowsPublishedOrderAndIsSymmetric)
{
    const auto eyelid = wound::tissue_thickness({.3, .28}), nose = wound::tissue_thickness({0, 0});
    const auto cheek = wound::tissue_thickness({.5, -.1}), forehead = wound::tissue_thickness({0, .6});
    EXPECT_LT(eyelid.dermis, forehead.dermis); // Chopra 2015: the upper eyelid is the thinnest,
    EXPECT_LT(forehead.dermis, nose.dermis);   // the lower nose the thickest
    EXPECT_GT(cheek.subcutis, 7);
    EXPECT_LT(forehead.subcutis, cheek.subcutis);
    EXPECT_DOUBLE_EQ(wound::tissue_thickness({-.5, -.1}).dermis, cheek.dermis);
    const auto far = wound::tissue_thickness({1e6, -1e6});
    EXPECT_TRUE(far.dermis > .7 && far.dermis < 2 && far.subcutis > 0 && far.subcutis <= 9);
}

TEST(Tissue, TableOneHasThePlacesThicknessWithinItsRanges)
{
    const auto layers = [](cv::Point2d face) {
        const auto tissue =
            wound::at_place(*optics::healing_tissue_named("table1"), wound::tissue_thickness(face));
        const auto& l = std::get<optics::SkinLayers>(tissue).layers;
        return cv::Vec3d(l[0].thickness_mm, l[1].thickness_mm, l[2].thickness_mm);
    };
    const cv::Vec3d eyelid = layers({.3, .28}), cheek = layers({.5, -.1}), nose = layers({0, 0});
    EXPECT_EQ(eyelid, cv::Vec3d(.2, 1, 4)) << "thinner than Table 1 allows";
    EXPECT_DOUBLE_EQ(cheek[1], wound::tissue_thickness({.5, -.1}).dermis);
    EXPECT_GT(nose[1], cheek[1]);
    EXPECT_GT(cheek[2], 7);
    for (double x = 0; x <= 1; x += .1)
        for (double y = -1; y <= 1; y += .1) {
            const cv::Vec3d here = layers({x, y});
            EXPECT_EQ(here[0], .2);
            EXPECT_TRUE(here[1] >= 1 && here[1] <= 4 && here[2] >= 4 && here[2] <= 9) << here;
        }
    // Layers that were given otherwise stay.
    const auto file = wound::at_place(optics::table1(.1, 2, 3), wound::tissue_thickness({0, 0}));
    EXPECT_EQ(std::get<optics::SkinLayers>(file).layers[1].thickness_mm, 2);
    EXPECT_EQ(std::get<optics::ChromophoreSkin>(
                  wound::at_place(optics::skin(optics::SkinTone::Light), wound::tissue_thickness({0, 0})))
                  .dermis_mm,
              1.8);
}

TEST(Tissue, HueGivesTheLayer)
{
    const cv::Vec3f skin = lab(skin_rgb);
    EXPECT_LT(wound::layer_reached(skin, skin), .01);
    EXPECT_LT(wound::layer_reached(lab({.50F, .32F, .24F}), skin), .3); // normal variation of skin
    const double blood = wound::layer_reached(lab(blood_color), skin);
    EXPECT_GT(blood, 1.5);
    const double graze = wound::layer_reached(lab({.55F, .27F, .21F}), skin);
    EXPECT_GT(graze, .3);
    EXPECT_LT(graze, blood);
    EXPECT_GT(wound::layer_reached(lab(fat), skin), 1.5);
    EXPECT_LE(wound::layer_reached(lab({0, 0, 0}), skin), 3);
    EXPECT_LE(wound::layer_reached(lab({1, 1, 1}), skin), 3);
}

/// Slope of the wall of disk(.45) over the middle half of `deep` mm; `side`: 1 right, -1 left.
double slope_of_wall(const cv::Mat1f& depth, float deep, int side)
{
    const auto distance_to = [&](float share) { // texels from the middle outwards to where it is so deep
        int texels = map_size / 2 - 1;
        while (depth(map_size / 2, map_size / 2 + side * texels) < share * deep)
            --texels;
        return texels;
    };
    return .5 * deep / (std::max(distance_to(.25F) - distance_to(.75F), 1) * patch_width_mm / map_size);
}

TEST(Depth, RedBedIsAsDeepAsTheDermisWithSlopingWallsAndFlatFloor)
{
    const cv::Mat1f mask = disk(.45);
    wound::DepthOptions options;
    const cv::Mat1f depth = wound::depth_map(painted(mask, blood_color), mask, patch_width_mm, options);
    const float middle = depth(map_size / 2, map_size / 2);
    EXPECT_GT(middle, .2 + .5 * options.tissue.dermis);
    EXPECT_LT(middle, .2 + options.tissue.dermis + options.tissue.subcutis);
    const int edge = map_size / 2 + static_cast<int>(.45 * map_size / 2); // the last texel inside
    EXPECT_NEAR(depth(map_size / 2, edge - 30), middle, .1 * middle);     // floor
    EXPECT_LT(depth(map_size / 2, edge), .2 * middle);
    EXPECT_NEAR(slope_of_wall(depth, middle, 1), 1, .35) << "a smoothstep over 1.5 times the depth";
}

TEST(Depth, WallsAreSteeperWhereTheyAreDarker)
{
    const cv::Mat1f mask = disk(.45);
    cv::Mat3f color = painted(mask, blood_color);
    color(cv::Rect(0, 0, map_size / 2, map_size)) *= .6; // in shadow; so is the skin there
    const cv::Mat1f depth = wound::depth_map(color, mask, patch_width_mm, {});
    const float middle = depth(map_size / 2, map_size / 2);
    EXPECT_GT(slope_of_wall(depth, middle, -1), 1.4 * slope_of_wall(depth, middle, 1));
}

TEST(Depth, RimIsSwollenAndSkinFarAwayIsUntouched)
{
    const cv::Mat1f mask = disk(.4);
    wound::DepthOptions options;
    const cv::Mat1f depth = wound::depth_map(painted(mask, blood_color), mask, patch_width_mm, options);
    double lowest = 0;
    cv::minMaxLoc(depth, &lowest);
    EXPECT_NEAR(lowest, -options.rim_swelling_mm, .05);
    EXPECT_EQ(depth(3, 3), 0);
    options.rim_swelling_mm = 0;
    cv::minMaxLoc(wound::depth_map(painted(mask, blood_color), mask, patch_width_mm, options), &lowest);
    EXPECT_EQ(lowest, 0);
}

TEST(Depth, ScalesWithTheTissueAtThePlace)
{
    const cv::Mat1f mask = disk(.4);
    wound::DepthOptions thin, thick;
    thin.tissue = wound::tissue_thickness({.3, .28});
    thick.tissue = wound::tissue_thickness({0, 0});
    const auto at_middle = [&](const wound::DepthOptions& options) {
        return wound::depth_map(painted(mask, blood_color), mask, patch_width_mm, options)(map_size / 2,
                                                                                           map_size / 2);
    };
    EXPECT_LT(at_middle(thin), .75F * at_middle(thick));
}

TEST(Depth, DeeperHuesAreDeeper)
{
    const cv::Mat1f mask = disk(.4);
    cv::Mat3f color = painted(mask, {.55F, .27F, .21F}); // a graze,
    cv::circle(color, {map_size / 2 - 20, map_size / 2}, 14,
               cv::Scalar(blood_color[0], blood_color[1], blood_color[2]),
               cv::FILLED); // bleeding on the left
    const cv::Mat1f depth = wound::depth_map(color, mask, patch_width_mm, {});
    EXPECT_GT(depth(map_size / 2, map_size / 2 - 20), 1.5F * depth(map_size / 2, map_size / 2 + 28));
}

TEST(Depth, ProfileIsTheRowThroughThePoint)
{
    cv::Mat1f depth = cv::Mat1f::zeros(8, 8);
    depth(5, 3) = 2;
    const auto profile = wound::depth_profile(depth, {0, .4}); // row 5 spans .25 to .5
    ASSERT_EQ(profile.size(), 8U);
    EXPECT_EQ(profile[3], 2);
    EXPECT_EQ(wound::depth_profile(depth, {0, 9}).size(), 8U);
}

TEST(Color, SrgbRoundTripIsExact)
{
    cv::Mat3b all(16, 16);
    for (int i = 0; i < 256; ++i)
        all(i / 16, i % 16) =
            cv::Vec3b(static_cast<uchar>(i), static_cast<uchar>(255 - i), static_cast<uchar>((i * 7) % 256));
    EXPECT_EQ(cv::norm(base::srgb_from_linear(base::linear_from_srgb(all)), all, cv::NORM_INF), 0);
    EXPECT_NEAR(base::linear_from_srgb(cv::Mat3b(1, 1, cv::Vec3b(188, 0, 255)))(0, 0)[0], .5029,
                1e-4); // IEC 61966-2-1
    const cv::Vec3f white = lab({1, 1, 1});
    EXPECT_NEAR(white[0], 100, .01);
    EXPECT_NEAR(white[1], 0, .1);
}

} // namespace
