#include "wound/optics/shading.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

#include "base/input_error.hpp"
#include "wound/optics/specular.hpp"

using std::numbers::pi;

namespace {

constexpr optics::WardModel ward_models[] = {optics::WardModel::Published, optics::WardModel::Duer,
                                             optics::WardModel::Bounded};

cv::Vec3d direction(double theta_deg, double phi_deg)
{
    const double theta = theta_deg * pi / 180, phi = phi_deg * pi / 180;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

double albedo(optics::WardModel model, double alpha, double theta_deg)
{
    return optics::ward_albedo(model, alpha, alpha, direction(theta_deg, 0));
}

// The albedo by its definition: a plain grid over the hemisphere of outgoing directions.
double albedo_on_a_grid(optics::WardModel model, double alpha_x, double alpha_y, const cv::Vec3d& incident)
{
    constexpr int rings = 400, sectors = 800;
    double sum = 0;
    for (int j = 0; j < rings; ++j)
        for (int k = 0; k < sectors; ++k) {
            const double z = (j + 0.5) / rings, phi = 2 * pi * (k + 0.5) / sectors;
            const double across = std::sqrt(1 - z * z);
            sum += z * optics::ward(model, alpha_x, alpha_y, incident,
                                    {across * std::cos(phi), across * std::sin(phi), z});
        }
    return sum * 2 * pi / (rings * sectors);
}

constexpr optics::DistanceRange anywhere{0, 1e9};

} // namespace

TEST(Ward, PublishedAlbedoFallsThenExceedsOneAtGrazingIncidence)
{
    EXPECT_NEAR(albedo(optics::WardModel::Published, 0.4, 0), 0.687, 1e-3);
    EXPECT_NEAR(albedo(optics::WardModel::Published, 0.4, 80), 0.262, 1e-3);
    EXPECT_NEAR(albedo(optics::WardModel::Published, 0.4, 89.9), 1.31, 5e-3);
}

TEST(Ward, BoundedAlbedoHasTheKnownValues)
{
    EXPECT_NEAR(albedo(optics::WardModel::Bounded, 0.4, 0), 0.840, 1e-3);
    EXPECT_NEAR(albedo(optics::WardModel::Bounded, 0.4, 60), 0.757, 1e-3);
    EXPECT_NEAR(albedo(optics::WardModel::Bounded, 0.4, 80), 0.772, 1e-3);
    EXPECT_NEAR(albedo(optics::WardModel::Bounded, 0.4, 89), 0.927, 1e-3);
}

TEST(Ward, AlbedoEqualsThePlainIntegralOverOutgoingDirections)
{
    for (optics::WardModel model : ward_models)
        for (double theta : {0.0, 50.0, 75.0}) {
            const cv::Vec3d incident = direction(theta, 20);
            EXPECT_NEAR(optics::ward_albedo(model, 0.3, 0.6, incident),
                        albedo_on_a_grid(model, 0.3, 0.6, incident), 2e-3)
                << static_cast<int>(model) << " at " << theta;
        }
}

TEST(Ward, BoundedModelNeverReflectsMoreThanItReceives)
{
    for (double alpha_x : {1e-4, 0.02, 0.4, 1.5})
        for (double alpha_y : {1e-4, 0.1, 1.5})
            for (double theta : {0.0, 45.0, 80.0, 89.9})
                EXPECT_LE(
                    optics::ward_albedo(optics::WardModel::Bounded, alpha_x, alpha_y, direction(theta, 30)),
                    1.0005)
                    << alpha_x << ' ' << alpha_y << ' ' << theta;
}

TEST(Ward, NarrowLobesReflectAlmostEverything)
{
    for (optics::WardModel model : ward_models)
        EXPECT_NEAR(albedo(model, 0.005, 0), 1, 1e-3);
}

TEST(Ward, IsReciprocal)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(0, 1);
    for (optics::WardModel model : ward_models)
        for (int n = 0; n < 1000; ++n) {
            const cv::Vec3d a = direction(90 * angle(random), 360 * angle(random));
            const cv::Vec3d b = direction(90 * angle(random), 360 * angle(random));
            const double there = optics::ward(model, 0.2, 0.5, a, b),
                         back = optics::ward(model, 0.2, 0.5, b, a);
            EXPECT_NEAR(there, back, 1e-12 * std::max(1.0, there));
        }
}

TEST(Ward, AnisotropyFollowsTheNamedAxes)
{
    // A slope of .1 along x and .5 along y: tilting the half vector along x costs more.
    const cv::Vec3d up(0, 0, 1);
    for (optics::WardModel model : ward_models) {
        EXPECT_LT(optics::ward(model, 0.1, 0.5, up, direction(30, 0)),
                  optics::ward(model, 0.1, 0.5, up, direction(30, 90)));
        EXPECT_DOUBLE_EQ(optics::ward(model, 0.3, 0.3, up, direction(30, 0)),
                         optics::ward(model, 0.3, 0.3, up, direction(30, 90)));
    }
}

TEST(Ward, IsZeroBelowTheHorizonAndFiniteAtIt)
{
    for (optics::WardModel model : ward_models) {
        EXPECT_EQ(optics::ward(model, 0.4, 0.4, direction(91, 0), direction(10, 0)), 0);
        EXPECT_EQ(optics::ward(model, 0.4, 0.4, direction(10, 0), direction(120, 0)), 0);
        EXPECT_EQ(optics::ward(model, 0.4, 0.4, {1, 0, 0}, {-1, 0, 0}), 0); // half vector 0
        for (double alpha : {1e-4, 0.4, 1.5})
            for (double z : {1e-300, 1e-12, 1e-4, 1e-3})
                for (double phi : {0.0, 90.0, 180.0}) {
                    cv::Vec3d grazing = direction(90, phi);
                    grazing[2] = z;
                    const double f = optics::ward(model, alpha, 0.4, grazing, {1, 0, z});
                    EXPECT_TRUE(std::isfinite(f) && f >= 0) << f;
                }
    }
}

TEST(Translucency, PublishedWeightIsSeventeenAtTheLight)
{
    EXPECT_NEAR(optics::translucency(optics::published_shading(), 0), 17.76, 0.01);  // .75^-10
    EXPECT_NEAR(optics::translucency(optics::published_shading(), 2), 0.2472, 1e-4); // 1.15^-10
}

TEST(Translucency, BoundedWeightStaysUnderItsBoundAndApproachesSmallPublishedWeights)
{
    optics::Shading bounded;
    const double bound = bounded.translucency_bound();
    EXPECT_NEAR(bound, 0.3 / 0.7, 1e-15);
    double last = bound;
    for (double d = 0; d < 50; d += 0.25) {
        const double w = optics::translucency(optics::published_shading(), d),
                     b = optics::translucency(bounded, d);
        EXPECT_LE(b, std::min(bound, w));
        EXPECT_LE(b, last); // farther is never brighter
        EXPECT_LE(w - b, w * std::pow(w / bound, 4) / 4 + 1e-15) << d;
        last = b;
    }
    EXPECT_NEAR(optics::translucency(bounded, 0), bound, 1e-6);
}

TEST(Translucency, BoundedWeightIsZeroWhereDiffuseReflectanceIsOne)
{
    optics::Shading bounded;
    bounded.rho_d = 1;
    EXPECT_EQ(optics::translucency(bounded, 1), 0);
}

TEST(Translucency, CanBeInterpolatedBetweenVertices)
{
    // A head 0.18 m wide, lit from the paper's distance; a 3 mm edge in any direction, anywhere on its
    // bounding sphere.
    const double units_per_m = optics::paper_units_per_m(0.18);
    const cv::Vec3d light(0, 0, optics::paper_light_distance / units_per_m);
    const auto weight = [&](const optics::Shading& shading, const cv::Vec3d& p) {
        return optics::translucency(shading, units_per_m * cv::norm(light - p));
    };
    for (const optics::Shading& shading : {optics::Shading{}, optics::published_shading()})
        for (double theta = 0; theta <= 180; theta += 5)
            for (double turn = 0; turn < 180; turn += 15) {
                const cv::Vec3d middle = 0.09 * direction(theta, 0), half_edge = 0.0015 * direction(turn, 0);
                const double between =
                    (weight(shading, middle + half_edge) + weight(shading, middle - half_edge)) / 2;
                EXPECT_NEAR(between / weight(shading, middle), 1, 1e-3) << theta << ' ' << turn;
            }
}

TEST(Translucency, PaperDistanceReproducesThePapersSetUp)
{
    // A head 0.22 m wide with its light at 0.2 m has the proportions of the paper.
    EXPECT_NEAR(optics::paper_units_per_m(0.22) * 0.2, 2, 1e-12);
}

TEST(Translucency, FallsWithTheDistanceOfTheLight)
{
    // A point of a head 0.22 m wide that faces away from the light gets the translucent term alone.
    const auto term = [](double distance_m) {
        optics::Light light;
        light.kind = optics::LightKind::PointWithoutFalloff;
        light.position = {0, 0, -distance_m};
        light.paper_units_per_m = optics::paper_units_per_m(0.22);
        return optics::shade(optics::published_shading(), light, {}, 1)[0];
    };
    EXPECT_NEAR(term(0.2), 0.7 * std::pow(0.2 * 2 + 0.75, -10), 1e-12);
    EXPECT_NEAR(term(1), 0.7 * std::pow(0.2 * 10 + 0.75, -10), 1e-12);
    EXPECT_GT(term(0.15), 1000 * term(2)); // was 1.04
}

TEST(Blend, PublishedDoesNotReachTheSkinColour)
{
    const base::Color w(0.5, 0.1, 0.1), r(0.7, 0.2, 0.2), s(0.6, 0.4, 0.3);
    EXPECT_EQ(optics::blend(optics::BlendModel::Published, w, r, s, 0), w);
    EXPECT_LT(
        cv::norm(optics::blend(optics::BlendModel::Published, w, r, s, 1) - (0.2 * w + 0.4 * r + 0.4 * s)),
        1e-15);
    const double gap =
        base::delta_e2000(base::lab_from_linear(optics::blend(optics::BlendModel::Published, w, r, s, 1)),
                          base::lab_from_linear(s));
    EXPECT_GT(gap, 5);
}

TEST(Blend, CorrectedIsExactAtBothEnds)
{
    const base::Color w(0.51, 0.13, 0.11), r(0.7, 0.2, 1.9), s(0.63, 0.41, 0.37);
    EXPECT_EQ(optics::blend(optics::BlendModel::Corrected, w, r, s, 0), w);
    EXPECT_EQ(optics::blend(optics::BlendModel::Corrected, w, r, s, 1), s);
    EXPECT_EQ(optics::blend(optics::BlendModel::Corrected, w, r, s, -1e-9), w);
    EXPECT_EQ(optics::blend(optics::BlendModel::Corrected, w, r, s, 1.5), s);
}

TEST(Blend, IsAConvexCombination)
{
    for (optics::BlendModel model : {optics::BlendModel::Published, optics::BlendModel::Corrected})
        for (double r = 0; r <= 1; r += 1.0 / 64) {
            EXPECT_NEAR(optics::blend(model, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, r)[0], 1, 1e-12);
            const base::Color weights = optics::blend(model, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, r);
            for (double weight : weights.val)
                EXPECT_GE(weight, 0) << r;
        }
}

TEST(Shade, PaperSceneHasTheClosedFormValue)
{
    // Light, viewer and normal in line, distance 2: C (.7 + .7 / 1.15^10) + .8 / (4 pi .16).
    optics::Light light;
    light.kind = optics::LightKind::PointWithoutFalloff;
    light.position = {0, 0, 2};
    optics::ShadedPoint point;
    point.albedo = {0.5, 0.25, 0};
    const base::Color c = optics::shade(optics::published_shading(), light, point, 1);
    const double diffuse = 0.7 + 0.7 * std::pow(1.15, -10), gloss = 0.8 / (4 * pi * 0.16);
    EXPECT_NEAR(c[0], 0.5 * diffuse + gloss, 1e-12);
    EXPECT_NEAR(c[2], gloss, 1e-12);
}

TEST(Shade, WhiteFurnace)
{
    // White skin under a white sky of radiance 1: each light has the strength d(omega) / pi, so that
    // irradiance / pi is 1. rho_s counts 1/pi of its albedo because eq. (8) leaves the pi of Lambert's law in
    // I.
    optics::Shading shading;
    shading.rho_ts = 0;
    constexpr int rings = 60, sectors = 120;
    for (double theta : {0.0, 60.0, 85.0}) {
        optics::ShadedPoint point;
        point.to_viewer = direction(theta, 0);
        double sum = 0;
        for (int j = 0; j < rings; ++j)
            for (int k = 0; k < sectors; ++k) {
                optics::Light light;
                light.kind = optics::LightKind::Directional;
                const double z = (j + 0.5) / rings, phi = 2 * pi * (k + 0.5) / sectors;
                light.direction = {std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi),
                                   z};
                light.strength = base::Color::all(2.0 / (rings * sectors)); // d(omega) / pi
                sum += optics::shade(shading, light, point, 1)[0];
            }
        const double expected =
            0.7 + 0.8 / pi * optics::ward_albedo(shading.ward_model, 0.4, 0.4, point.to_viewer);
        EXPECT_NEAR(sum, expected, 3e-3) << theta;
        EXPECT_LE(sum, 1);
    }
}

TEST(Shade, ShadowLeavesOnlyTheTranslucentTerm)
{
    optics::Light light;
    light.position = {0, 0, 0.2};
    light.paper_units_per_m = optics::paper_units_per_m(0.22);
    const optics::ShadedPoint point;
    const optics::Shading shading;
    EXPECT_NEAR(optics::shade(shading, light, point, 0)[0], 0.7 * optics::translucency(shading, 2), 1e-12);
}

TEST(Shade, PointLightFallsWithTheSquareOfDistanceAndDirectionalDoesNot)
{
    optics::Shading shading;
    shading.rho_ts = 0;
    optics::Light light;
    light.reference_distance_m = 0.5;
    light.position = {0, 0, 1};
    const double far = optics::shade(shading, light, {}, 1)[0];
    light.position = {0, 0, 0.5};
    const double near = optics::shade(shading, light, {}, 1)[0];
    EXPECT_NEAR(near / far, 4, 1e-12);
    light.kind = optics::LightKind::Directional;
    EXPECT_NEAR(optics::shade(shading, light, {}, 1)[0], near, 1e-12);
}

TEST(Shade, BrightestPointFacingTheLightReflectsNoMoreThanItReceives)
{
    optics::Shading shading;
    shading.rho_s = 0;
    optics::Light light;
    light.kind = optics::LightKind::PointWithoutFalloff;
    for (double z : {0.0, 0.01, 1.0, 5.0}) {
        light.position = {0, 0, z};
        EXPECT_LE(optics::shade(shading, light, {}, 1)[0], 1 + 1e-12) << z;
    }
}

TEST(ShadingInput, PresetsAreAccepted)
{
    for (const optics::Shading& shading :
         {optics::Shading{}, optics::published_shading(), optics::skin_shading()})
        EXPECT_NO_THROW(optics::check_shading(shading, anywhere, "scene.json: /shading"));
    EXPECT_NO_THROW(optics::check_light(optics::Light{}, "scene.json: /lights/0"));
}

TEST(ShadingInput, OutOfRangeIsRefusedByName)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                     inf = std::numeric_limits<double>::infinity();
    struct Case
    {
        double optics::Shading::*field;
        const char* name;
        std::vector<double> bad;
    };
    const Case cases[] = {
        {&optics::Shading::rho_d, "rho_d", {-0.1, 1.1, nan}},
        {&optics::Shading::rho_ts, "rho_ts", {-1, inf, nan}},
        {&optics::Shading::rho_s, "rho_s", {-1, 2, nan}},
        {&optics::Shading::alpha, "alpha", {nan, inf}},
        {&optics::Shading::beta, "beta", {nan, -inf, 0, -0.1}},
        {&optics::Shading::gamma, "gamma", {-0.01, nan, inf}},
        {&optics::Shading::alpha_x, "alpha_x", {0, -1, 2, nan}},
        {&optics::Shading::alpha_y, "alpha_y", {0, 1e-9, inf, nan}},
    };
    for (const Case& c : cases)
        for (double bad : c.bad) {
            optics::Shading shading;
            shading.*c.field = bad;
            try {
                optics::check_shading(shading, anywhere, "scene.json: /shading");
                FAIL() << c.name << " = " << bad << " was accepted";
            } catch (const base::InputError& error) {
                EXPECT_NE(std::string(error.what()).find(std::string("/shading/") + c.name),
                          std::string::npos)
                    << error.what();
            }
        }
}

TEST(ShadingInput, UndefinedTranslucencyIsRefusedOnlyAtReachableDistances)
{
    optics::Shading shading;
    shading.alpha = -0.2; // alpha d + beta = 0 at d = 3.75
    EXPECT_NO_THROW(optics::check_shading(shading, {0.9, 3.1}, "scene"));
    EXPECT_THROW(optics::check_shading(shading, {0.9, 4}, "scene"), base::InputError);
    EXPECT_THROW(optics::check_shading(shading, {0.9, 3.75}, "scene"), base::InputError);
}

TEST(ShadingInput, ReachableDistancesSpanTheBoundingSphere)
{
    optics::Light light;
    light.position = {0, 0, 0.2};
    light.paper_units_per_m = optics::paper_units_per_m(0.22);
    const optics::DistanceRange range = optics::translucency_distances(light, {0, 0, 0}, 0.11);
    EXPECT_NEAR(range.min, 0.9, 1e-12);
    EXPECT_NEAR(range.max, 3.1, 1e-12);
    light.kind = optics::LightKind::Directional;
    EXPECT_NEAR(optics::translucency_distances(light, {0.5, 0, 0}, 0.11).min, 0.9,
                1e-12); // a sideways offset changes nothing
}

TEST(ShadingInput, BadLightsAreRefused)
{
    const auto refused = [](auto&& spoil) {
        optics::Light light;
        spoil(light);
        EXPECT_THROW(optics::check_light(light, "scene.json: /lights/0"), base::InputError);
    };
    refused([](optics::Light& l) { l.position[1] = NAN; });
    refused([](optics::Light& l) { l.strength[2] = -1; });
    refused([](optics::Light& l) { l.strength[0] = INFINITY; });
    refused([](optics::Light& l) { l.reference_distance_m = 0; });
    refused([](optics::Light& l) {
        l.kind = optics::LightKind::Directional;
        l.direction = {0, 0, 0};
    });
    refused([](optics::Light& l) { l.paper_units_per_m = -1; });
}

TEST(Shading, ATermWithoutACoefficientIsNotDrawn)
{
    optics::Shading shading = optics::published_shading();
    EXPECT_TRUE(shading.lambertian() && shading.translucent() && shading.glossy());
    shading.rho_d = shading.rho_ts = shading.rho_s = 0;
    EXPECT_FALSE(shading.lambertian() || shading.translucent() || shading.glossy());
}
