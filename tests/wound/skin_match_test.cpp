#include "wound/skin_match.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "base/color.hpp"
#include "wound/membrane.hpp"
#include "wound/synthetic/noise.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace {

using cv::Vec3f;
using wound::match_to_skin;
using wound::Patch;

constexpr int n = 256;
constexpr float radius = 48; // texels, of the test wound
const Vec3f light_skin{.68f, .47f, .36f}, dark_skin{.107f, .045f, .026f}, yellow_skin{.75f, .50f, .20f},
    blood{.36f, .04f, .038f};
const float nan = std::numeric_limits<float>::quiet_NaN();

float from_middle(int x, int y)
{
    return std::hypot(float(x) - (n - 1) / 2.f, float(y) - (n - 1) / 2.f);
}

/// Skin with blotches and pores of a few per cent.
cv::Mat3f skin_of(const Vec3f& tone, std::uint32_t seed = 3)
{
    const wound::Noise noise(seed);
    cv::Mat3f skin(n, n);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const cv::Point2f p{float(x) / n, float(y) / n};
            skin(y, x) = tone * (1 + .05f * noise.sum(p * 5, 2) + .05f * noise.sum(p * 50, 2));
        }
    return skin;
}

/// A round red wound in skin, with a reddened halo of strength `halo`.
Patch wound_in(const cv::Mat3f& skin, float halo = 0)
{
    Patch patch{skin.clone(), cv::Mat1f(n, n, 1.f), cv::Mat1f(n, n), cv::Mat1f(n, n, 1.f), 40};
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const float out = from_middle(x, y) - radius;
            patch.mask(y, x) = std::clamp(.5f - out, 0.f, 1.f);
            const float redness = halo * std::exp(-std::max(out, 0.f) / 8);
            patch.color(y, x)[1] *= std::exp(-redness);
            patch.color(y, x)[2] *= std::exp(-.9f * redness);
            patch.color(y, x) += (blood - patch.color(y, x)) * patch.mask(y, x);
        }
    return patch;
}

Vec3f composite(const Patch& patch, const cv::Mat3f& face, int x, int y)
{
    return face(y, x) + (patch.color(y, x) - face(y, x)) * patch.opacity(y, x);
}

Vec3f mean_in_ring(const cv::Mat3f& map, float from, float to)
{
    Vec3f sum;
    float count = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            if (from_middle(x, y) >= from && from_middle(x, y) < to)
                sum += map(y, x), ++count;
    return sum / count;
}

void expect_sound(const Patch& result)
{
    for (int y = 0; y < result.color.rows; ++y)
        for (int x = 0; x < result.color.cols; ++x) {
            for (int k = 0; k < 3; ++k)
                ASSERT_TRUE(result.color(y, x)[k] >= 0 && result.color(y, x)[k] <= 1) << x << ", " << y;
            ASSERT_TRUE(result.opacity(y, x) >= 0 && result.opacity(y, x) <= 1) << x << ", " << y;
        }
}

float greatest_opacity(const Patch& patch, bool (*where)(int x, int y))
{
    float most = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            if (where(x, y))
                most = std::max(most, patch.opacity(y, x));
    return most;
}

TEST(SkinMatch, IsDeterministic)
{
    const Patch patch = wound_in(skin_of(yellow_skin), 1);
    const Patch a = match_to_skin(patch, skin_of(dark_skin)), b = match_to_skin(patch, skin_of(dark_skin));
    EXPECT_EQ(cv::norm(a.color, b.color, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(a.opacity, b.opacity, cv::NORM_INF), 0);
}

TEST(SkinMatch, CoversTheWoundAndEndsInABandAroundIt)
{
    const Patch result = match_to_skin(wound_in(skin_of(light_skin)), skin_of(light_skin));
    float least_inside = 1;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            if (from_middle(x, y) < radius)
                least_inside = std::min(least_inside, result.opacity(y, x));
    EXPECT_GT(least_inside, .99f);
    EXPECT_EQ(greatest_opacity(result, [](int x, int y) { return from_middle(x, y) > 1.85f * radius; }), 0);
}

TEST(SkinMatch, LeavesAPhotoOfTheFacesOwnSkinUnchanged)
{
    const cv::Mat3f face = skin_of(light_skin);
    const Patch patch = wound_in(face), result = match_to_skin(patch, face);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            for (int k = 0; k < 3 && result.opacity(y, x) > 0; ++k)
                ASSERT_NEAR(result.color(y, x)[k], patch.color(y, x)[k], .03f * patch.color(y, x)[k] + .004f)
                    << x << ", " << y;
}

TEST(SkinMatch, ShowsNeitherForeignSkinNorAHaloAroundTheWound)
{
    for (const Vec3f& photo_tone : {yellow_skin, dark_skin, light_skin})
        for (const Vec3f& face_tone : {light_skin, dark_skin}) {
            const cv::Mat3f face = skin_of(face_tone, 8);
            const Patch result = match_to_skin(wound_in(skin_of(photo_tone)), face);
            cv::Mat3f seen(n, n);
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x)
                    seen(y, x) = composite(result, face, x, y);
            for (float from = 1.06f; from < 2; from += .1f) {
                const Vec3f here = mean_in_ring(seen, from * radius, (from + .1f) * radius);
                const Vec3f far = mean_in_ring(face, from * radius, (from + .1f) * radius);
                for (int k = 0; k < 3; ++k)
                    EXPECT_NEAR(here[k] / far[k], 1, .03) << "ring at " << from << " radii, channel " << k;
            }
        }
}

TEST(SkinMatch, HasNoStepAlongTheFeather)
{
    const cv::Mat3f face(n, n, dark_skin);
    const Patch result = match_to_skin(wound_in(skin_of(yellow_skin), 1), face);
    float steepest_opacity = 0, steepest_color = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 1; x < n; ++x)
            if (from_middle(x, y) > 1.1f * radius) {
                steepest_opacity =
                    std::max(steepest_opacity, std::abs(result.opacity(y, x) - result.opacity(y, x - 1)));
                const Vec3f step = composite(result, face, x, y) - composite(result, face, x - 1, y);
                steepest_color = std::max(steepest_color, std::abs(base::luminance(step)));
            }
    EXPECT_LT(steepest_opacity, .12f);
    EXPECT_LT(steepest_color, .008f); // the pores of the photo's own skin make steps of .004
}

TEST(SkinMatch, KeepsTheFacesOwnPoresOnHealthySkin)
{
    cv::Mat3f face = skin_of(light_skin, 5);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            face(y, x) *= (x / 2 + y / 2) % 2 ? 1.1f : .9f; // stubble of two texels
    const Patch result = match_to_skin(wound_in(skin_of(yellow_skin)), face);
    double along = 0, own = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            if (from_middle(x, y) > 1.35f * radius && from_middle(x, y) < 1.6f * radius) {
                const float sign = (x / 2 + y / 2) % 2 ? 1.f : -1.f;
                along += sign * composite(result, face, x, y)[1];
                own += sign * face(y, x)[1];
            }
    EXPECT_GT(along / own, .75);
    EXPECT_LT(along / own, 1.1);
}

TEST(SkinMatch, KeepsTheBedAsRedOnDarkSkinAsOnLight)
{
    const Patch patch = wound_in(skin_of(light_skin));
    const Vec3f dark = mean_in_ring(match_to_skin(patch, skin_of(dark_skin)).color, 0, .8f * radius);
    const Vec3f light = mean_in_ring(match_to_skin(patch, skin_of(light_skin)).color, 0, .8f * radius);
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(dark[k], light[k], .002f);
        EXPECT_NEAR(dark[k], blood[k], .1f * blood[k]);
    }
}

TEST(SkinMatch, CarriesTheInflamedRimAsARatioToHealthySkin)
{
    const Patch patch = wound_in(skin_of(light_skin), .8f);
    for (const Vec3f& tone : {light_skin, dark_skin}) {
        const cv::Mat3f face = skin_of(tone);
        const Patch result = match_to_skin(patch, face);
        const Vec3f rim = mean_in_ring(result.color, radius + 2, radius + 8),
                    healthy = mean_in_ring(face, radius + 2, radius + 8);
        const float ratio = rim[1] / rim[0] / (healthy[1] / healthy[0]);
        EXPECT_LT(ratio, .75f); // .67 in the photograph
        EXPECT_GT(ratio, .45f);
    }
}

TEST(SkinMatch, RemovesPartOfAColorCastFromTheBed)
{
    const Vec3f cast{1.f, 1.f, .55f}; // tungsten light
    Patch patch = wound_in(skin_of(light_skin));
    for (Vec3f& color : patch.color)
        color = color.mul(cast);
    const Vec3f bed = mean_in_ring(match_to_skin(patch, skin_of(light_skin)).color, 0, .8f * radius);
    EXPECT_GT(bed[2] / bed[1], 1.12f * .55f * blood[2] / blood[1]);
    EXPECT_LT(bed[2] / bed[1], blood[2] / blood[1]);
}

TEST(SkinMatch, StopsBeforePixelsThatAreNotSkin)
{
    for (const Vec3f& background :
         {Vec3f(0, 0, 0), Vec3f(.2f, .21f, .22f), Vec3f(.1f, .2f, .5f), Vec3f(.9f, .9f, .9f)})
    {
        Patch patch = wound_in(skin_of(light_skin));
        const auto is_background = [](int x, int) { return x > n / 2 + 1.3f * radius; };
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                if (is_background(x, y))
                    patch.color(y, x) = background;
        const Patch result = match_to_skin(patch, skin_of(light_skin));
        EXPECT_LT(greatest_opacity(result, is_background), .02f) << background;
        EXPECT_GT(result.opacity(n / 2, n / 2 + int(1.08f * radius)),
                  .5f); // the skin before it is still used
        EXPECT_GT(result.opacity(n / 2, n / 2 - int(1.25f * radius)), .9f); // the other side is not affected
    }
}

TEST(SkinMatch, IsTransparentWhereThePhotographHasNoData)
{
    Patch patch = wound_in(skin_of(light_skin));
    patch.opacity(cv::Rect(0, 0, n, n / 2 - 20)) = 0; // the photo ends in the middle of the wound
    patch.color(cv::Rect(0, 0, n, n / 2 - 20)).setTo(nan);
    const Patch result = match_to_skin(patch, skin_of(light_skin));
    expect_sound(result);
    EXPECT_EQ(greatest_opacity(result, [](int, int y) { return y < n / 2 - 20; }), 0);
    EXPECT_GT(result.opacity(n / 2 + 10, n / 2), .99f);
}

TEST(SkinMatch, FlattensSmallHighlightsAndKeepsTheRest)
{
    Patch patch = wound_in(skin_of(light_skin));
    cv::circle(patch.color, {n / 2, n / 2}, 2, cv::Scalar(.95, .9, .9), cv::FILLED);
    const Patch result = match_to_skin(patch, skin_of(light_skin));
    EXPECT_LT(result.color(n / 2, n / 2)[1], .25f);
    EXPECT_NEAR(result.color(n / 2 + 20, n / 2)[0], blood[0], .1f * blood[0]);
}

TEST(SkinMatch, FillsInAFaceThatIsKnownOnlyInPart)
{
    cv::Mat3f face = skin_of(dark_skin);
    face(cv::Rect(0, 0, n / 2, n)).setTo(cv::Scalar::all(nan));
    const Patch result = match_to_skin(wound_in(skin_of(yellow_skin)), face);
    expect_sound(result);
    EXPECT_NEAR(result.color(n / 2, n / 2 - int(1.2f * radius))[1] / dark_skin[1], 1, .2f);
}

// The photograph shows only wound, so nothing beyond the wound's border comes from the photograph.
TEST(SkinMatch, WithoutSkinInThePhotoTheFacesOwnSkinIsUsed)
{
    for (const Vec3f& face_tone : {light_skin, dark_skin}) {
        const cv::Mat3f face = skin_of(face_tone);
        Patch patch = wound_in(skin_of(yellow_skin)), other = wound_in(skin_of(dark_skin));
        patch.color.setTo(blood);
        patch.shows_skin = other.shows_skin = false;
        const Patch result = match_to_skin(patch, face);
        EXPECT_FALSE(result.shows_skin);
        EXPECT_EQ(greatest_opacity(result, [](int x, int y) { return from_middle(x, y) > 1.1f * radius; }),
                  0);
        const Vec3f bed = mean_in_ring(result.color, 0, .8f * radius);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(bed[k], mean_in_ring(match_to_skin(other, face).color, 0, .8f * radius)[k], 1e-6f);
            EXPECT_NEAR(bed[k] / blood[k], 1, .1f) << "nothing indicates a wrong white balance";
        }
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                for (int k = 0; k < 3 && result.opacity(y, x) > 0; ++k)
                    ASSERT_NEAR(result.color(y, x)[k], bed[k], .01f * bed[k])
                        << "a fringe at " << x << ", " << y;
    }
    EXPECT_TRUE(match_to_skin(wound_in(skin_of(light_skin)), skin_of(light_skin)).shows_skin);
}

TEST(SkinMatch, WithoutSkinOrFaceABluishPhotoIsBalancedByItsBlood)
{
    Patch patch = wound_in(skin_of(light_skin));
    patch.shows_skin = false;
    const Vec3f as_is = mean_in_ring(match_to_skin(patch, {}).color, 0, .8f * radius);
    for (Vec3f& color : patch.color)
        color[2] *= 1.5f;
    const Patch result = match_to_skin(patch, {});
    expect_sound(result);
    const Vec3f bed = mean_in_ring(result.color, 0, .8f * radius);
    EXPECT_LT(bed[2] / bed[1], 1.3f * as_is[2] / as_is[1]);
}

TEST(SkinMatch, SurvivesHostileInput)
{
    const cv::Mat3f face = skin_of(light_skin);
    const Patch good = wound_in(skin_of(light_skin));
    const auto with = [&](auto change) {
        Patch patch = wound_in(skin_of(light_skin));
        change(patch);
        return patch;
    };
    const cv::Mat3f unknown(n, n, Vec3f::all(nan)), tiny(1, 1, light_skin),
        infinite(n, n, Vec3f::all(std::numeric_limits<float>::infinity()));
    for (const cv::Mat3f& skin : {unknown, tiny, infinite, cv::Mat3f(), cv::Mat3f(n, n, Vec3f::all(0)),
                                  cv::Mat3f(n, n, Vec3f::all(-1))})
        expect_sound(match_to_skin(good, skin));
    expect_sound(match_to_skin(with([](Patch& p) { p.color.setTo(0); }), face));
    expect_sound(match_to_skin(with([](Patch& p) { p.color.setTo(nan); }), face));
    expect_sound(match_to_skin(with([](Patch& p) { p.color.setTo(1e30); }), face));
    expect_sound(match_to_skin(with([](Patch& p) { p.mask.setTo(0); }), face));
    expect_sound(match_to_skin(with([](Patch& p) { p.mask.setTo(1); }), face));
    expect_sound(match_to_skin(with([](Patch& p) { p.mask.setTo(nan); }), face));
    expect_sound(match_to_skin(with([](Patch& p) { p.mask(cv::Rect(0, 0, n, n / 2)) = 1; }), face));
    expect_sound(match_to_skin(with([](Patch& p) { p.opacity.release(); }), face));
    expect_sound(match_to_skin(with([](Patch& p) { p.opacity.setTo(0); }), face));
}

TEST(SkinMatch, AMaskAtThePatchesEdgeStillFadesOut)
{
    Patch patch = wound_in(skin_of(light_skin));
    patch.mask(cv::Rect(0, 0, n / 2, n)) = 1;
    const Patch result = match_to_skin(patch, skin_of(light_skin));
    EXPECT_EQ(greatest_opacity(result,
                               [](int x, int y) {
                                   return std::min({x, y, n - 1 - x, n - 1 - y}) == 0;
                               }),
              0);
}

TEST(Membrane, FollowsDataOfHighWeightAndIsHarmonicBetween)
{
    constexpr int side = 64;
    cv::Mat3f data(side, side, Vec3f::all(0));
    cv::Mat1f weight(side, side, 0.f);
    for (int i = 0; i < side; ++i)
        for (int edge : {0, side - 1}) {
            data(i, edge) = Vec3f::all(float(edge) / (side - 1)), weight(i, edge) = 1e4f;
            data(edge, i) = Vec3f::all(float(i) / (side - 1)), weight(edge, i) = 1e4f;
        }
    const cv::Mat3f m = wound::membrane(data, weight);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            ASSERT_NEAR(m(y, x)[1], float(x) / (side - 1), .01f)
                << x << ", " << y; // the harmonic function with these edges
}

TEST(Membrane, IsZeroWithoutData)
{
    const cv::Mat3f m = wound::membrane(cv::Mat3f(32, 32, Vec3f::all(5)), cv::Mat1f(32, 32, 0.f));
    EXPECT_EQ(cv::norm(m, cv::NORM_INF), 0);
}

} // namespace
