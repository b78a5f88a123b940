// The closed forms of transport `preintegrated` against integrals over the profile of our own photon walk.
#include "wound/optics/transport.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "wound/optics/diffusion_profile.hpp"
#include "wound/optics/skin_presets.hpp"

namespace {

using optics::DiffusionProfile;

constexpr double endless = std::numeric_limits<double>::infinity();

/// Isotropic and index-matched, with a millimetre between two scatterings.
optics::Stack medium(double single_albedo, double thickness_mm = endless)
{
    return {.layers = {{.sigma_a = (1 - single_albedo) / single_albedo,
                        .sigma_s_reduced = 1,
                        .g = 0,
                        .n = 1,
                        .thickness_mm = thickness_mm}},
            .n_above = 1,
            .n_below = 1};
}

TEST(Transport, WidthIsTheAlbedoTimesTheScatteringLength)
{
    for (const double single : {.3, .5, .7, .8, .9, .95, .97}) {
        const DiffusionProfile profile = optics::diffusion_profile(medium(single), {.photons = 40'000});
        EXPECT_NEAR(profile.radius_mm / 2.5, optics::diffusion_width(profile.albedo, 1),
                    .1 * profile.albedo)
            << single;
    }
}

TEST(Transport, FlatSkinIsLambertian)
{
    for (double cosine = -1; cosine < 1.001; cosine += .1) {
        EXPECT_NEAR(optics::received_bent(cosine, 0), std::max(cosine, 0.0), 1e-12);
        EXPECT_NEAR(optics::received_bent(cosine, 1e-4), std::max(cosine, 0.0), 1e-4);
    }
}

// Two independent programs computed the light in the dark half of a half-lit plane, for three albedos and mean free
// paths. A filter of 4 mm reaches as far as light does.
TEST(Transport, EdgeOfAShadowIsThatOfTheSlabThatOthersComputed)
{
    struct Channel
    {
        double albedo, single_albedo, free_path_mm;
        std::vector<std::pair<double, double>> edge; // mm, share
    };
    const std::vector<Channel> channels{
        {.55, .9348, .7987, {{.1, .395}, {.2, .333}, {.5, .222}, {1, .126}, {2, .048}, {3, .020}}},
        {.35, .8076, .5944, {{.1, .343}, {.2, .263}, {.5, .137}, {1, .054}, {2, .011}, {3, .0024}}},
        {.25, .6920, .4223, {{.1, .285}, {.2, .193}, {.5, .074}, {1, .019}, {2, .0016}, {3, .0002}}}};
    constexpr double filter = 4;
    double worst = 0;
    for (const Channel& channel : channels) {
        const double width = optics::diffusion_width(channel.albedo, channel.free_path_mm / channel.single_albedo);
        for (const auto& [x, share] : channel.edge) {
            const double dark = optics::softened(.5 - x / (2 * filter), width, filter);
            worst = std::max(worst, std::abs(dark - share));
            EXPECT_NEAR(dark, share, .04) << channel.albedo << ", " << x << " mm";
            EXPECT_NEAR(optics::softened(.5 + x / (2 * filter), width, filter), 1 - dark, 1e-12);
        }
        EXPECT_NEAR(optics::softened(0, width, filter), 0, 1e-12);
        EXPECT_NEAR(optics::softened(1, width, filter), 1, 1e-12);
    }
    EXPECT_LT(worst, .035);
}

TEST(Transport, SlabPassesWhatTheWalkSays)
{
    double worst = 0;
    for (const double single : {.5, .8, .9348}) {
        const double albedo =
            optics::reflectance(medium(single), optics::ReflectanceModel::AddingDoubling).r;
        const double width = optics::diffusion_width(albedo, 1);
        for (const double widths : {1., 2., 4., 8., 16.}) {
            const double t = optics::reflectance(medium(single, widths * width),
                                                 optics::ReflectanceModel::AddingDoubling)
                                 .t;
            worst = std::max(worst, std::abs(t - optics::passed(widths * width, width)));
            EXPECT_NEAR(optics::passed(widths * width, width), t, .1) << single << ' ' << widths;
        }
    }
}

TEST(Transport, LengthOfAMediumIsItsOwnAndOfSkinLongestInRed)
{
    const optics::SkinLayers layers{
        .layers = {{"all", {.1, .2, .4}, {.9, 1.8, 3.6}, 0, 1, endless}}, .n_above = 1, .n_below = 1};
    const base::Color own = optics::scattering_length_mm(layers);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(own[c] * .9 * (1 << c), 1, .12);
    EXPECT_EQ(optics::scattering_length_mm(layers), own);
    const base::Color skin = optics::scattering_length_mm(optics::skin(optics::SkinTone::Light).layers());
    EXPECT_GT(skin[0], skin[1]);
    EXPECT_GT(skin[1], skin[2]);
}

TEST(Transport, BallsReturnMoreThanHollowsAndNothingNegative)
{
    for (const double albedo : {0., .2, .5, .9})
        for (const double turn : {1e-3, .01, .1, 1., 1e3}) {
            EXPECT_GE(optics::bend_gain(albedo, turn), 1);
            EXPECT_LE(optics::bend_gain(albedo, -turn), 1);
            EXPECT_GT(optics::bend_gain(albedo, -turn), .4);
            for (double cosine = -1; cosine < 1.001; cosine += .1) {
                EXPECT_GE(optics::received_bent(cosine, turn), 0);
                EXPECT_LE(albedo * optics::bend_gain(albedo, turn) * optics::received_bent(cosine, turn), 1);
            }
        }
}

/// Mean over a cosine-weighted hemisphere of what comes from it, seen from this direction.
double even_light(const cv::Vec3d& o, double sigma)
{
    constexpr int steps = 64;
    double sum = 0;
    for (int a = 0; a < steps; ++a)
        for (int b = 0; b < steps; ++b) {
            const double square = (a + .5) / steps, phi = 2 * CV_PI * (b + .5) / steps;
            const double across = std::sqrt(square), up = std::sqrt(1 - square);
            sum += optics::layered_oren_nayar({across * std::cos(phi), across * std::sin(phi), up}, o, sigma);
        }
    return sum / (steps * steps);
}

TEST(LayeredOrenNayar, KeepsEvenLightAndIsReciprocal)
{
    for (const double sigma : {0., .3, .6}) {
        double returned = 0;
        constexpr int steps = 40;
        for (int k = 0; k < steps; ++k) {
            const double square = (k + .5) / steps;
            returned += even_light({std::sqrt(square), 0, std::sqrt(1 - square)}, sigma) / steps;
        }
        if (sigma <= .3) {
            EXPECT_NEAR(returned, sigma == 0 ? 1 : shared::FACETS_RETURN, 2e-3) << sigma;
        }
        EXPECT_LT(returned, 1.002) << sigma;
        EXPECT_GT(returned, .85) << sigma;
    }
    const cv::Vec3d i = cv::normalize(cv::Vec3d(.6, .2, .3)), o = cv::normalize(cv::Vec3d(-.1, .5, .8));
    EXPECT_NEAR(optics::layered_oren_nayar(i, o, .4), optics::layered_oren_nayar(o, i, .4), 1e-12);
}

TEST(LayeredOrenNayar, IsBrightestTowardsTheLight)
{
    const cv::Vec3d i = cv::normalize(cv::Vec3d(1, 0, .5)), back = i, away(-i[0], i[1], i[2]);
    EXPECT_GT(optics::layered_oren_nayar(i, back, .3), 1.2 * optics::layered_oren_nayar(i, away, .3));
    EXPECT_NEAR(optics::layered_oren_nayar(i, back, 0), optics::layered_oren_nayar(i, away, 0), 1e-12);
    EXPECT_EQ(optics::layered_oren_nayar({.6, 0, -.8}, back, .3), 0);
}

} // namespace
