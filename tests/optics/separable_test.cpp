// The kernel of transport `separable` against the profile and against two programs that walk photons.
#include "wound/optics/separable.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "wound/optics/transport.hpp"

namespace {

/// beyond_edge() from circles around the point: a share acos(x/r) / pi of one of radius r lies beyond.
double by_circles(double x)
{
    constexpr int steps = 200'000;
    constexpr double end = 60;
    double sum = 0, before = optics::left_within(x, 1);
    for (int i = 0; i < steps; ++i) {
        const double r = x + (end - x) * (i + 1) / steps, middle = r - .5 * (end - x) / steps;
        const double within = optics::left_within(r, 1);
        sum += (within - before) * std::acos(x / middle) / CV_PI;
        before = within;
    }
    return sum;
}

TEST(Separable, EdgeIsThatOfTheProfile)
{
    EXPECT_NEAR(optics::beyond_edge(0, 1), .5, 1e-6);
    for (const double x : {.05, .3, 1., 3., 8.}) {
        EXPECT_NEAR(optics::beyond_edge(x, 1), by_circles(x), 2e-5) << x;
        EXPECT_NEAR(optics::beyond_edge(2 * x, 2), optics::beyond_edge(x, 1), 1e-12) << x;
    }
}

TEST(Separable, KernelKeepsLightAndSpreadsEachChannelByItsWidth)
{
    const base::Color width(.485, .264, .159); // mm, Burley's of a slab that others computed
    const auto taps = optics::separable_kernel(width);
    base::Color sum, dark; // dark: a light that begins .5 mm from here
    for (const optics::SeparableTap& tap : taps) {
        sum += tap.weight;
        if (tap.place * width[0] > .5)
            dark += tap.weight;
        for (int c = 0; c < 3; ++c)
            EXPECT_GE(tap.weight[c], 0);
    }
    const std::array<double, 3> others{.222, .137, .074}; // of two independent programs
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sum[c], 1, 1e-8);
        EXPECT_NEAR(dark[c], others[std::size_t(c)], .06); // as coarse as the taps
    }
    for (const optics::SeparableTap& tap : optics::separable_kernel({1, 0, 0}))
        EXPECT_EQ(tap.weight[1], tap.place == 0 ? 1 : 0);
}

} // namespace
