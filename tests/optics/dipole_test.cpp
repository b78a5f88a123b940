// The dipole and the multipole against their own integrals and limits, against adding-doubling and against
// the photon walk.
#include "wound/optics/dipole.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

#include "wound/optics/adding_doubling.hpp"
#include "wound/optics/diffusion_profile.hpp"
#include "wound/optics/skin_presets.hpp"
#include "wound/optics/transport.hpp"

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Over the disc of a radius, in steps even in the radius' logarithm.
double integral(const std::function<double(double)>& profile, double radius)
{
    double sum = 0;
    constexpr double step = .01;
    for (double log_r = std::log(radius) - 20; log_r < std::log(radius); log_r += step) {
        const double r = std::exp(log_r + step / 2);
        sum += 2 * std::numbers::pi * r * r * step * profile(r);
    }
    return sum;
}

TEST(Dipole, IntegratesToItsDiffuseAlbedo)
{
    for (const double albedo : {.3, .8, .99})
        for (const double n : {1., 1.4}) {
            const optics::DiffusiveMedium medium{albedo, 2.5, optics::boundary_factor(n)};
            const optics::Dipole dipole(medium);
            // Jensen et al. 2001, eq. (15).
            const double root = std::sqrt(3 * (1 - albedo));
            const double authors =
                albedo / 2 * (1 + std::exp(-4. / 3 * medium.boundary * root)) * std::exp(-root);
            EXPECT_NEAR(dipole.total(), authors, 1e-12);
            const auto at = [&](double r) { return dipole.at_squared(r * r); };
            EXPECT_NEAR(integral(at, 200), authors, 1e-3 * authors);
            for (const double r : {.05, .4, 2.})
                EXPECT_NEAR(integral(at, r), dipole.within(r), 2e-3 * authors) << albedo << ' ' << r;
        }
    EXPECT_NEAR(optics::boundary_factor(1), 1, 1e-12);
    EXPECT_NEAR(optics::boundary_factor(1.4), (1 + .528985) / (1 - .528985), 1e-4);
}

TEST(Multipole, OfInfiniteThicknessIsTheDipole)
{
    const optics::DiffusiveMedium medium{.9, 1.5, optics::boundary_factor(1.3)};
    const optics::Dipole dipole(medium);
    for (const double thickness : {endless, 60.}) {
        const optics::Multipole slab(medium, thickness);
        for (const double r : {.01, .3, 1., 4.})
            EXPECT_NEAR(slab.reflected_at(r), dipole.at_squared(r * r), 1e-9 * dipole.at_squared(0)) << r;
        EXPECT_NEAR(slab.reflected(0), dipole.total(), 1e-9);
        EXPECT_NEAR(slab.transmitted(0) + slab.unscattered(), 0, 1e-9);
    }
}

TEST(Multipole, KeepsEnergyAndItsTransformIsItsIntegral)
{
    for (const double albedo : {.4, .9, .999, 1.})
        for (const double thickness : {.05, .5, 3., 20.})
            for (const double n : {1., 1.4}) {
                const optics::Multipole slab({albedo, 1, optics::boundary_factor(n)}, thickness);
                const double r = slab.reflected(0), t = slab.transmitted(0) + slab.unscattered();
                EXPECT_GE(r, 0) << albedo << ' ' << thickness;
                EXPECT_GE(slab.transmitted(0), 0) << albedo << ' ' << thickness;
                EXPECT_LE(r + t, 1 + 1e-9) << albedo << ' ' << thickness;
                if (albedo < 1 && thickness >= .5) {
                    EXPECT_NEAR(integral([&](double x) { return slab.reflected_at(x); }, 300), r, 2e-3);
                    EXPECT_NEAR(integral([&](double x) { return slab.transmitted_at(x); }, 300),
                                slab.transmitted(0), 2e-3);
                }
            }
}

/// Its own accuracy: diffusion theory is for media that scatter much more than they absorb.
TEST(Multipole, IsNearAddingDoublingWhereLightScattersOften)
{
    for (const double thickness : {2., 5.}) {
        const optics::Multipole slab({.99, 1, 1}, thickness);
        const optics::Response exact = optics::adding_doubling(
            {.layers = {{.sigma_a = .01, .sigma_s_reduced = .99, .n = 1, .thickness_mm = thickness}}},
            {.incidence = optics::Incidence::Normal});
        EXPECT_NEAR(slab.reflected(0), exact.r, .05) << thickness;
        EXPECT_NEAR(slab.transmitted(0) + slab.unscattered(), exact.t, .05) << thickness;
    }
}

TEST(LayeredProfile, OfOneThickLayerIsTheDipole)
{
    const optics::SkinLayers tissue{
        .layers = {{"one", {.02, .1, .3}, {1.2, 1.5, 2}, 0, 1.4, endless}}, .n_above = 1, .n_below = 1.4};
    const optics::LayeredProfile profile(tissue);
    for (std::size_t c = 0; c < 3; ++c) {
        const double a = tissue.layers[0].sigma_a[c], s = tissue.layers[0].sigma_s_reduced[c];
        const optics::Dipole dipole({s / (a + s), a + s, optics::boundary_factor(1.4)});
        EXPECT_NEAR(profile.albedo()[c], dipole.total(), 1e-9);
        for (const double r : {.05, .3, 1., 3.}) {
            const double expected = dipole.at_squared(r * r) / dipole.total();
            EXPECT_NEAR(double(profile.at_squared(r * r)[c]), expected, .03 * expected) << c << ' ' << r;
        }
    }
}

/// Cutting a layer in two changes what diffusion theory says by little, and a dark layer on top darkens.
TEST(LayeredProfile, PutsLayersTogether)
{
    const auto albedo = [](std::vector<optics::Layer> layers) {
        return optics::LayeredProfile({.layers = std::move(layers), .n_above = 1, .n_below = 1}).albedo()[1];
    };
    const optics::Layer deep{"deep", {.05}, {2}, 0, 1, endless};
    optics::Layer upper = deep, dark = deep;
    upper.thickness_mm = 1;
    dark.thickness_mm = .1;
    dark.sigma_a = {3};
    EXPECT_NEAR(albedo({upper, deep}), albedo({deep}), .04);
    EXPECT_LT(albedo({dark, deep}), albedo({deep}) - .1);
}

TEST(LayeredProfile, OfSkinSpreadsRedFarthestAndIsAShareOfOne)
{
    const optics::LayeredProfile profile(*optics::tissue_preset("light"));
    std::array<double, 3> all{}, radius{};
    constexpr double step = .01;
    for (double log_r = std::log(1e-4); log_r < std::log(40.); log_r += step) {
        const double r = std::exp(log_r);
        for (std::size_t c = 0; c < 3; ++c) {
            const double ring = 2 * std::numbers::pi * r * r * step * double(profile.at_squared(r * r)[c]);
            all[c] += ring;
            radius[c] += r * ring;
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(all[c], 1, .01);
        EXPECT_GT(profile.albedo()[c], 0);
        EXPECT_LT(profile.albedo()[c], 1);
    }
    EXPECT_GT(radius[0], radius[1]);
    EXPECT_GT(radius[1], radius[2]);
}

TEST(DipoleInversion, GivesTheAlbedoAndAnEdgeNearTheMediums)
{
    const optics::DipoleInversion inversion(1);
    for (const double albedo : {.05, .21, .55, .8}) {
        constexpr double length = .7;
        const optics::Dipole dipole = inversion.dipole_of(albedo, length);
        EXPECT_NEAR(dipole.total(), albedo, 1e-9);
        const double width = optics::diffusion_width(albedo, length);
        // Share of the light within some widths: a dipole lacks the peak, but not the spread.
        for (const double widths : {2., 5., 10.})
            EXPECT_NEAR(dipole.within(widths * width) / albedo, optics::left_within(widths * width, width),
                        .12)
                << albedo << ' ' << widths;
    }
}

} // namespace
