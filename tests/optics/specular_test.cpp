// The highlight of skin: energy, reciprocity, limits, and the closed form for light from all around.
#include "wound/optics/specular.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "wound/optics/fresnel.hpp"
#include "wound/optics/surroundings.hpp"

namespace {

constexpr double one_turn = 2 * std::numbers::pi;

cv::Vec3d at_angle(double theta_deg, double phi = 0)
{
    const double theta = theta_deg * std::numbers::pi / 180;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

optics::Shading skin_with(double alpha)
{
    optics::Shading shading = optics::skin_shading();
    shading.alpha_x = shading.alpha_y = alpha;
    return shading;
}

constexpr std::array<optics::Finish, 3> finishes{
    optics::Finish{}, {.wetness = 1}, {.wetness = .4, .slope_variance = .1}};

} // namespace

TEST(Specular, OfSkinReflectsAboutFresnelsShareAndHardlyEverMore)
{
    for (const double alpha : {.05, .3, .6})
        for (const optics::Finish& finish : finishes)
            for (const double theta : {0., 30., 45., 60., 75., 85., 89.9}) {
                const double albedo = optics::specular_albedo(skin_with(alpha), finish, at_angle(theta)),
                             fresnel = optics::fresnel_reflectance(std::cos(theta * one_turn / 360));
                EXPECT_LE(albedo, 1.02 * fresnel) << alpha << ' ' << theta;
                if (theta < 40) {
                    EXPECT_GE(albedo, .75 * fresnel) << alpha << ' ' << theta;
                }
            }
}

TEST(Specular, FresnelReflectanceIsThatOfIndexOnePointFour)
{
    for (double theta = 0; theta < 80; theta += 5) {
        const double cosine = std::cos(theta * one_turn / 360);
        EXPECT_NEAR(optics::fresnel_reflectance(cosine), optics::fresnel(1, 1.4, cosine), .02) << theta;
    }
    EXPECT_NEAR(optics::fresnel_reflectance(0), 1, 1e-6); // the constants are floats
}

TEST(Specular, AlbedoIsThePlainIntegralOverAllDirections)
{
    constexpr int rings = 400, sectors = 400;
    for (const optics::Finish& finish : finishes) {
        const optics::Shading shading = optics::skin_shading();
        const cv::Vec3d incident = at_angle(55, .3);
        double sum = 0;
        for (int j = 0; j < rings; ++j)
            for (int k = 0; k < sectors; ++k) {
                const double z = (j + .5) / rings, phi = one_turn * (k + .5) / sectors,
                             across = std::sqrt(1 - z * z);
                sum += z * optics::specular(shading, finish, incident,
                                            {across * std::cos(phi), across * std::sin(phi), z});
            }
        const double expected = sum * one_turn / (rings * sectors) / std::numbers::pi; // I is irradiance / pi
        EXPECT_NEAR(optics::specular_albedo(shading, finish, incident), expected, .01 * expected);
    }
}

TEST(Specular, MirrorRaysAverageToTheAlbedo)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(1e-9, 1);
    for (const optics::Finish& finish : finishes) {
        const cv::Vec3d viewer = at_angle(65, 1);
        double sum = 0;
        constexpr int rays = 200'000;
        for (int n = 0; n < rays; ++n) {
            const optics::MirrorRay ray = optics::mirror_ray(optics::skin_shading(), finish, viewer,
                                                             unit(random), unit(random), unit(random));
            EXPECT_NEAR(cv::norm(ray.direction), 1, 1e-9);
            EXPECT_GE(ray.weight, 0);
            sum += ray.weight;
        }
        const double expected = optics::specular_albedo(optics::skin_shading(), finish, viewer);
        EXPECT_NEAR(sum / rays, expected, .02 * expected);
    }
}

TEST(Specular, ClosedFormForEvenLightIsNearTheAlbedo)
{
    for (const double alpha : {.06, .3, .6})
        for (const double wetness : {0., .5, 1.})
            for (const double theta : {0., 30., 60., 75., 85.}) {
                const optics::Shading shading = skin_with(alpha);
                const double albedo = optics::specular_albedo(shading, {wetness}, at_angle(theta)),
                             closed = optics::ambient_specular(shading, {wetness},
                                                               std::cos(theta * one_turn / 360));
                EXPECT_NEAR(closed, albedo, .01 + .15 * albedo) << alpha << ' ' << wetness << ' ' << theta;
            }
}

TEST(Specular, OfSkinIsReciprocalAndFollowsTheFieldsOfTheScene)
{
    const cv::Vec3d i = at_angle(40), o = at_angle(60, 2.5);
    optics::Shading shading = optics::skin_shading();
    const double before = optics::specular(shading, {.2, .03}, i, o);
    EXPECT_NEAR(optics::specular(shading, {.2, .03}, o, i), before, 1e-12);
    shading.rho_s *= 2;
    EXPECT_NEAR(optics::specular(shading, {.2, .03}, i, o), 2 * before, 1e-12);
    shading.alpha_x = .5;
    EXPECT_GT(optics::specular(shading, {}, at_angle(0), at_angle(60)),
              optics::specular(shading, {}, at_angle(0), at_angle(60, one_turn / 4)));
    const double bounded = optics::specular(shading, {}, i, o);
    shading.ward_model = optics::WardModel::Duer;
    EXPECT_NE(optics::specular(shading, {}, i, o), bounded);
}

TEST(Specular, FilmIsClearAndVarianceBroadens)
{
    const optics::Shading shading = optics::skin_shading();
    const auto seen = [&](const optics::Finish& finish, double theta) {
        return optics::specular(shading, finish, at_angle(theta), at_angle(theta));
    };
    EXPECT_GT(seen({.wetness = 1}, 0), 3 * seen({}, 0));
    EXPECT_LT(seen({.wetness = 1}, 20), seen({}, 20));
    EXPECT_LT(seen({.wetness = 1, .slope_variance = .1}, 0), seen({.wetness = 1}, 0) / 5);
    EXPECT_GT(seen({.wetness = 1, .slope_variance = .1}, 20), seen({.wetness = 1}, 20));
}

TEST(Specular, OfSkinIsFiniteAtTheExtremes)
{
    for (const double alpha : {1e-4, .3, 1.5})
        for (const optics::Finish& finish : finishes)
            for (const double z : {0., 1e-300, 1e-12, 1e-4, 1e-3})
                for (const double phi : {0., one_turn / 4, one_turn / 2}) {
                    cv::Vec3d grazing = at_angle(90, phi);
                    grazing[2] = z;
                    const double f = optics::specular(skin_with(alpha), finish, grazing, {1, 0, z});
                    EXPECT_TRUE(std::isfinite(f) && f >= 0) << f;
                }
    EXPECT_EQ(optics::specular(optics::skin_shading(), {}, {1, 0, 0}, {-1, 0, 0}), 0); // half vector 0
}

TEST(SpecularOcclusion, HasTheDiffuseOcclusionAsItsMeanAndIsStrongestAtGrazingAngles)
{
    for (const double open : {.1, .4, .75, 1.}) {
        constexpr int steps = 20'000;
        double mean = 0, last = 0;
        for (int n = 0; n < steps; ++n) {
            const double cosine = (n + .5) / steps, share = optics::specular_occlusion(open, cosine);
            mean += share * 2 * cosine / steps;
            EXPECT_GE(share, last);
            last = share;
        }
        EXPECT_NEAR(mean, open, 1e-3);
    }
    EXPECT_EQ(optics::specular_occlusion(1, 0), 1);
    EXPECT_EQ(optics::above_horizon(0), 1);
    EXPECT_EQ(optics::above_horizon(-1), 0);
    EXPECT_LT(optics::specular_occlusion(0, .99), 1e-6);
}

// In a hollow whose walls see each other alike, light that does not leave is reflected once more: open (1 + q
// + q^2 ...) with q = (1 - open) albedo.
TEST(Visibility, IsNearTheSumOverAllReflections)
{
    for (double open = 0; open <= 1; open += .05) {
        double last = open;
        for (const double albedo : {0., .1, .3, .5, .7, .8}) {
            const double seen = optics::visibility(open, base::Color::all(albedo))[1];
            EXPECT_GE(seen, last - 1e-12);
            EXPECT_LE(seen, 1.001);
            EXPECT_NEAR(seen, open / (1 - (1 - open) * albedo), .12) << open << ' ' << albedo;
            last = seen;
        }
    }
}
