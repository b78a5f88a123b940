// Where light comes out of tissue again, against a slab that two independent programs computed, and against
// the walk in depth alone.
#include "wound/optics/diffusion_profile.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>

#include "wound/optics/monte_carlo.hpp"
#include "wound/optics/skin_presets.hpp"

namespace {

using optics::DiffusionProfile;

optics::Stack half_space(double single_albedo, double free_path_mm)
{
    return {.layers = {{.sigma_a = (1 - single_albedo) / free_path_mm,
                        .sigma_s_reduced = single_albedo / free_path_mm,
                        .g = 0,
                        .n = 1,
                        .thickness_mm = std::numeric_limits<double>::infinity()}},
            .n_above = 1,
            .n_below = 1};
}

TEST(DiffusionProfile, IsThatOfTheSlabThatOthersComputed)
{
    struct Channel
    {
        double single_albedo, free_path_mm, radius_mm;
        std::vector<std::pair<double, double>> edge, disc; // mm, share
    };
    const std::vector<Channel> channels{
        {.9348,
         .7987,
         1.199,
         {{.1, .395}, {.2, .333}, {.5, .222}, {1, .126}, {2, .048}, {3, .020}},
         {{.1, .096}, {.5, .371}, {1, .587}, {2, .812}, {5, .978}}},
        {.6920,
         .4223,
         .391,
         {{.1, .285}, {.2, .193}, {.5, .074}, {1, .019}, {2, .0016}, {3, .0002}},
         {{.1, .253}, {.5, .728}, {1, .915}, {2, .991}, {5, 1}}}};
    for (const Channel& channel : channels) {
        const DiffusionProfile profile = optics::diffusion_profile(
            half_space(channel.single_albedo, channel.free_path_mm), {.photons = 200'000});
        EXPECT_NEAR(profile.radius_mm, channel.radius_mm, .02 * channel.radius_mm);
        for (const auto& [x, share] : channel.edge)
            EXPECT_NEAR(profile.beyond_edge(x), share, .01) << x << " mm";
        for (const auto& [r, share] : channel.disc)
            EXPECT_NEAR(profile.within(r), share, .02) << r << " mm";
    }
}

// How much comes back does not depend on whether anybody asks where.
TEST(DiffusionProfile, HoldsTheLightThatTheWalkInDepthReturns)
{
    const optics::Stack table1 = optics::table1().channel(1);
    const DiffusionProfile profile = optics::diffusion_profile(table1, {.photons = 100'000});
    const optics::Response response = optics::monte_carlo(table1, {.photons = 100'000, .seed = 2});
    const double entered = 1 - optics::specular_reflectance(table1);
    EXPECT_NEAR(profile.albedo, response.r_without_specular / entered, .006);
    EXPECT_NEAR(std::accumulate(profile.rings.begin(), profile.rings.end(), 0.0), profile.albedo, 1e-12);
}

TEST(DiffusionProfile, GoesFromAllToNothing)
{
    const DiffusionProfile profile = optics::diffusion_profile(half_space(.9, 1), {.photons = 20'000});
    EXPECT_NEAR(profile.beyond_edge(0), .5, 1e-9);
    EXPECT_NEAR(profile.within(1e3), 1, 1e-9);
    EXPECT_EQ(profile.within(0), 0);
    for (double x = .01; x < 20; x *= 1.3) {
        EXPECT_LE(profile.beyond_edge(1.3 * x), profile.beyond_edge(x));
        EXPECT_GE(profile.within(1.3 * x), profile.within(x));
    }
}

TEST(DiffusionProfile, DoesNotDependOnTheNumberOfThreads)
{
    const optics::Stack stack = half_space(.9, 1);
    const DiffusionProfile alone = optics::diffusion_profile(stack, {.photons = 5000, .threads = 1}),
                           together = optics::diffusion_profile(stack, {.photons = 5000, .threads = 3});
    EXPECT_EQ(alone.rings, together.rings);
    EXPECT_EQ(alone.radius_mm, together.radius_mm);
}

// Red light spreads further than green and blue.
TEST(DiffusionProfile, OfSkinIsWidestInRed)
{
    const auto skin =
        optics::diffusion_profile(optics::skin(optics::SkinTone::Light).layers(), {.photons = 500});
    EXPECT_GT(skin[0].radius_mm, 2 * skin[1].radius_mm);
    EXPECT_GT(skin[1].radius_mm, skin[2].radius_mm);
    for (const DiffusionProfile& profile : skin)
        EXPECT_NEAR(std::accumulate(profile.rings.begin(), profile.rings.end(), 0.0), profile.albedo, 1e-9);
}

} // namespace
