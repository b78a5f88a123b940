// Walks in bodies whose answers are known: an endless slab, of which two independent programs give where the
// light comes out; and a ball that absorbs nothing.
#include "reference/random_walk.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "bodies.hpp"
#include "reference/single_albedo.hpp"

namespace {

using reference::Medium;
using reference::Random;

/// The tissue of the table: isotropic, index-matched, diffuse albedo .55/.35/.25.
const Medium slab_medium{.extinction = {1e3 / .7987, 1e3 / .5944, 1e3 / .4223},
                         .single_albedo = {.9348, .8076, .6920}};

/// Per channel, where light leaves the half space that entered it at the origin: x and the distance, mm.
struct Leaving
{
    base::Color x_mm, r_mm, weight;
};
std::vector<Leaving> walks(const Medium& medium, int count)
{
    const reference::HalfSpace half_space({0, 0, 0}, {0, 0, 1});
    std::vector<Leaving> leaving;
    for (int i = 0; i < count; ++i) {
        Random random(7, 0, std::uint64_t(i));
        const auto ends = reference::random_walk(medium, half_space, {0, 0, 0}, {0, 0, 1}, random.bits());
        Leaving one{.weight = ends.reflected};
        for (int c = 0; c < 3; ++c) {
            const glm::dvec3 at = ends.exits[std::size_t(c)].at;
            one.x_mm[c] = 1e3 * at.x;
            one.r_mm[c] = 1e3 * std::hypot(at.x, at.y);
        }
        leaving.push_back(one);
    }
    return leaving;
}

base::Color total(const std::vector<Leaving>& all)
{
    base::Color sum(0, 0, 0);
    for (const Leaving& one : all)
        sum += one.weight;
    return sum;
}

base::Color quotient(const base::Color& a, const base::Color& b)
{
    return {a[0] / b[0], a[1] / b[1], a[2] / b[2]};
}

// Light falls on x > 0 alone; share of the full brightness so many mm inside the dark.
TEST(RandomWalk, LightSpreadsIntoTheDarkHalfOfASlab)
{
    struct Row
    {
        double x_mm;
        base::Color share;
    };
    constexpr int count = 300'000;
    const std::vector<Row> table{{.1, {.395, .343, .285}}, {.2, {.333, .263, .193}},
                                 {.5, {.222, .137, .074}}, {1, {.126, .054, .019}},
                                 {2, {.048, .011, .0016}}, {3, {.020, .0024, .0002}}};
    const std::vector<Leaving> all = walks(slab_medium, count);
    const base::Color whole = total(all);
    for (const Row& row : table) {
        base::Color beyond(0, 0, 0); // by reciprocity, a walk goes from the eye to the light
        for (const Leaving& one : all)
            for (int c = 0; c < 3; ++c)
                beyond[c] += one.x_mm[c] > row.x_mm ? one.weight[c] : 0;
        const base::Color share = quotient(beyond, whole);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(share[c], row.share[c], .01) << row.x_mm << " mm, channel " << c;
    }
}

TEST(RandomWalk, LightLeavesWithinADisc)
{
    struct Row
    {
        double r_mm;
        base::Color share;
    };
    const std::vector<Row> table{{.1, {.096, .165, .253}},
                                 {.5, {.371, .558, .728}},
                                 {1, {.587, .788, .915}},
                                 {2, {.812, .947, .991}},
                                 {5, {.978, .999, 1}}};
    const std::vector<Leaving> all = walks(slab_medium, 300'000);
    const base::Color whole = total(all);
    base::Color radius(0, 0, 0);
    for (const Leaving& one : all)
        radius += one.r_mm.mul(one.weight);
    for (const Row& row : table) {
        base::Color within(0, 0, 0);
        for (const Leaving& one : all)
            for (int c = 0; c < 3; ++c)
                within[c] += one.r_mm[c] <= row.r_mm ? one.weight[c] : 0;
        const base::Color share = quotient(within, whole);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(share[c], row.share[c], .02) << row.r_mm << " mm, channel " << c;
    }
    const base::Color mean = quotient(radius, whole), expected(1.199, .646, .391);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean[c], expected[c], .02) << "mean radius, channel " << c;
}

// Nothing is absorbed, so all the light comes out in every walk, but for what roulette ends early.
TEST(RandomWalk, ABallThatAbsorbsNothingIsAWhiteFurnace)
{
    const reference::Ball ball(.002);
    for (const double n : {1.0, 1.4})
        for (const double g : {0.0, .8, -.5}) {
            const Medium white{.extinction = {1000, 3000, 9000}, .single_albedo = {1, 1, 1}, .g = g, .n = n};
            base::Color sum(0, 0, 0);
            constexpr int count = 4000;
            for (int i = 0; i < count; ++i) {
                Random random(3, std::uint64_t(1000 * n + 10 * g + 100), std::uint64_t(i));
                const auto ends =
                    reference::random_walk(white, ball, {0, 0, ball.radius}, {0, 0, 1}, random.bits());
                for (const reference::WalkExit& exit : ends.exits)
                    EXPECT_NEAR(glm::length(exit.at), ball.radius, 1e-9) << "n " << n << ", g " << g;
                sum += ends.reflected;
            }
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(sum[c] / count, 1, .05) << "n " << n << ", g " << g << ", channel " << c;
        }
}

// The table is radiative transfer's, the walk goes step by step: two ways to the same number.
TEST(RandomWalk, AlbedoTableAgreesWithTheWalk)
{
    for (const double n : {1.0, 1.4})
        for (const double g : {0.0, .8}) {
            const reference::AlbedoTable table(g, n);
            const base::Color wanted(.75, .45, .15);
            // One extinction for all, so that all channels share their walks.
            const Medium medium{
                .extinction = {1000, 1000, 1000}, .single_albedo = table.single_of(wanted), .g = g, .n = n};
            constexpr int count = 100'000;
            const base::Color albedo = total(walks(medium, count)) / count;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(albedo[c], wanted[c], .004) << "n " << n << ", g " << g << ", channel " << c;
        }
}

TEST(AlbedoTable, InvertsItself)
{
    const reference::AlbedoTable table(.8, 1.4);
    for (double diffuse = 0; diffuse <= reference::AlbedoTable::largest_diffuse; diffuse += .005)
        EXPECT_NEAR(table.diffuse_of(table.single_of(diffuse)), diffuse, 1e-9);
    EXPECT_DOUBLE_EQ(table.single_of(0), 0);
    EXPECT_LT(table.single_of(1), 1);
    EXPECT_DOUBLE_EQ(table.single_of(-1), 0);
}

// The slab's single-scattering albedos came from an outside fit (Chiang, Kutz & Burley 2016) to .55/.35/.25.
TEST(AlbedoTable, AgreesWithAnOutsideFit)
{
    const reference::AlbedoTable table(0, 1);
    EXPECT_NEAR(table.diffuse_of(.9348), .55, .01);
    EXPECT_NEAR(table.diffuse_of(.8076), .35, .01);
    EXPECT_NEAR(table.diffuse_of(.6920), .25, .01);
}

} // namespace
