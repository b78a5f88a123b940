// The day's maps and the skin under a wound, checked without a device. tests/passes/ compares both with the
// renderer on every day.
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "wound/drawn_region.hpp"
#include "wound/prepare.hpp"
#include "wound/reflectance_table.hpp"
#include "wound/skin_blend.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace {

constexpr double last_day = 60;
const base::Color own(.55, .36, .27);
const cv::Vec3d up(0, 0, 1);

wound::PatchPlace place(cv::Point2d at, double facing = 1)
{
    return {.at = at, .facing = facing, .right = {1, 0, 0}, .down = {0, -1, 0}, .geometric = up};
}

/// A small wound that heals by contraction, and its tissue.
struct Wound
{
    Wound()
    {
        healing.model = wound::HealingModel::Contraction;
        const wound::LutRows rows =
            wound::lut_rows(optics::skin(optics::SkinTone::Light), healing, 16, last_day);
        table = wound::bake_reflectance_table(rows.days, 16, optics::ReflectanceModel::Calibrated);
        axes = rows.axes;
    }

    void on(double day)
    {
        today = wound::wound_at(prepared, healing, day);
        maps = wound::maps_on(prepared, today, cv::Rect({}, prepared.patch.color.size()));
    }
    wound::SkinPoint seen(const wound::PatchPlace& at) const
    {
        return wound::with_wound({own, up}, {today, maps, table, axes}, at, optics::BlendModel::Corrected);
    }

    wound::PreparedWound prepared = wound::prepare(wound::synthesize({}), {.patch_size = 128});
    wound::Healing healing;
    cv::Mat3f table;
    shared::LutAxes axes;
    wound::WoundDay today;
    wound::DayMaps maps;
};

void expect_untouched(const wound::SkinPoint& skin)
{
    EXPECT_EQ(skin.albedo, own);
    EXPECT_EQ(skin.normal, up);
    EXPECT_EQ(skin.occlusion, 1);
    EXPECT_EQ(skin.wetness, 0);
    EXPECT_EQ(skin.tautness, 0);
}

} // namespace

TEST(DayMaps, AreThePatchItselfOnDayZero)
{
    Wound wound;
    wound.on(0);
    const wound::Patch& patch = wound.prepared.patch;
    EXPECT_LT(cv::norm(wound.maps.color, wound::day0_color(patch), cv::NORM_INF), 1e-5);
    std::vector<cv::Mat1f> state;
    cv::split(wound.maps.state, state);
    for (int tissue : {0, 1}) {
        EXPECT_LT(cv::norm(state[tissue], patch.depth_mm, cv::NORM_INF), 1e-5);
        EXPECT_LT(cv::norm(state[2 + tissue], patch.mask, cv::NORM_INF), 1e-5);
    }
}

TEST(DayMaps, OfARegionAreThoseOfTheWholePatch)
{
    Wound wound;
    wound.on(8);
    const cv::Rect region = wound::drawn_region(wound.prepared, wound.healing);
    ASSERT_LT(region.area(), wound.maps.region.area());
    const wound::DayMaps part = wound::maps_on(wound.prepared, wound.today, region);
    EXPECT_EQ(cv::norm(part.color, wound.maps.color(region), cv::NORM_INF), 0);
    for (const cv::Point2d at : {cv::Point2d(0, 0), {.21, -.13}, {-.3, .05}})
        EXPECT_LT(cv::norm(wound::sample(part, at).color - wound::sample(wound.maps, at).color), 1e-6);
    EXPECT_EQ(wound::sample(part, {-1, -1}).color[3], 0) << "outside the region there is no wound";
}

TEST(SkinBlend, IsTheWoundsOwnColorOnDayZeroAndTheSkinWhenHealed)
{
    Wound wound;
    wound.on(0);
    const wound::SkinPoint fresh = wound.seen(place({0, 0}));
    const cv::Vec4d texture = wound::sample(wound.maps, {0, 0}).color;
    ASSERT_EQ(texture[3], 1);
    EXPECT_LT(cv::norm(fresh.albedo - base::Color(texture[0], texture[1], texture[2])), 1e-9);
    EXPECT_EQ(fresh.wetness, 1);
    EXPECT_EQ(wound::finish_of(fresh).wetness, 1);
    EXPECT_EQ(wound::with_gloss(optics::skin_shading(), fresh).rho_s, optics::skin_shading().rho_s);
    optics::Shading one_lobe = optics::skin_shading();
    one_lobe.specular_model = optics::SpecularModel::Ward;
    EXPECT_LT(wound::with_gloss(one_lobe, fresh).alpha_x, one_lobe.alpha_x);
    EXPECT_EQ(wound::with_gloss(optics::published_shading(), fresh), optics::published_shading())
        << "eq. (7) alone";
    wound.on(365);
    EXPECT_LT(cv::norm(wound.seen(place({0, 0})).albedo - own), 1e-6);
    EXPECT_LT(wound.seen(place({0, 0})).wetness, 1e-6);
}

TEST(SkinBlend, LeavesSkinUnchangedThatTheWoundDoesNotReach)
{
    Wound wound;
    wound.on(3);
    expect_untouched(wound.seen(place({-.999, .999})));
    expect_untouched(wound.seen(place({5, 0})));
    expect_untouched(wound.seen(place({0, 0}, 0)));
}

TEST(SkinBlend, BumpsAreSeenFromNearAndBroadenTheHighlightFromFar)
{
    Wound wound;
    wound.healing.model = wound::HealingModel::Face;
    wound.on(0);
    const double texel_mm = wound.prepared.patch.width_mm / 128;
    EXPECT_GT(wound::relief_parameters(wound.today, texel_mm).bump_mm, 0);
    double roughness = 0, variance_near = 0, variance_far = 0;
    for (double x = -.3; x < .3; x += .01) { // the floor, far from the walls
        const wound::SkinPoint here = wound.seen(place({x, 0})), beside = wound.seen(place({x + .02, 0}));
        roughness += cv::norm(here.normal - beside.normal);
        variance_near += here.slope_variance;
        wound::PatchPlace far = place({x, 0});
        far.footprint = {.02, .02};
        variance_far += wound.seen(far).slope_variance;
    }
    EXPECT_EQ(variance_near, 0);
    EXPECT_GT(variance_far, 0);
    EXPECT_GT(roughness / 60, .02);
    wound.healing.model = wound::HealingModel::Contraction; // the paper's wounds have a depth alone
    wound.on(0);
    EXPECT_EQ(wound::relief_parameters(wound.today, texel_mm).bump_mm, 0);
    EXPECT_EQ(wound::relief_parameters(wound.today, texel_mm).slope_limit, 0);
}

TEST(SkinBlend, WallsOfTheCavityTiltTheNormalAndOccludeLight)
{
    Wound wound;
    wound.on(0);
    double steepest = 0, darkest = 1, sum = 0;
    for (double x = -.6; x < .6; x += .02) {
        const wound::SkinPoint skin = wound.seen(place({x, 0}));
        EXPECT_NEAR(cv::norm(skin.normal), 1, 1e-12);
        steepest = std::max(steepest, std::abs(skin.normal[0]));
        darkest = std::min(darkest, skin.occlusion);
        sum += skin.normal[0];
    }
    EXPECT_GT(steepest, .1);
    EXPECT_LT(darkest, .95);
    EXPECT_LT(std::abs(sum) * .02, .1) << "the slopes of both walls must cancel";
}
