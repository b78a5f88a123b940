// H3 against its definition in extended precision; the two healing models; validation.
#include "wound/healing/healing.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "base/input_error.hpp"

namespace {

using wound::H3;
using wound::Healing;
using wound::HealingModel;

long double reference(const H3& c, double day)
{
    const long double t = day;
    const long double x = c.theta * t;
    const long double root = std::sqrt(1 + x * x);
    const long double decline = x >= 0 ? 1 / (root + x) : root - x; // exp(-asinh x)
    return std::exp(-static_cast<long double>(c.delta) * std::pow(t, static_cast<long double>(c.gamma))) *
           decline;
}

TEST(Healing, H3EqualsItsDefinitionInExtendedPrecision)
{
    double worst = 0;
    for (double gamma : {.5, .7, 1., 1.5, 2.336, 4.})
        for (double delta : {0., 1e-9, .004261, .2251, 1., 10.})
            for (double theta : {-1., -.361, -1e-6, 0., .0168, 1.})
                for (double t : {0., 1e-12, 1e-3, .5, 1., 3., 8.45, 30., 365., 1e4, 1e6, 1e9}) {
                    const H3 curve{delta, gamma, theta, 0};
                    const long double expected = t == 0 ? 1 : reference(curve, t);
                    const double actual = wound::unhealed_ratio(curve, t);
                    ASSERT_TRUE(std::isfinite(actual) && actual >= 0);
                    if (expected < std::numeric_limits<double>::min())
                        ASSERT_LT(actual, 2 * std::numeric_limits<double>::min());
                    else
                        worst = std::max(worst, static_cast<double>(std::abs(actual - expected) / expected));
                }
    EXPECT_LE(worst, 1e-12);
}

TEST(Healing, H3SolvesItsDifferentialEquation)
{
    const H3 curve{.2251, 1.316, -.361, .1};
    for (double t : {.3, 2., 7., 15.}) {
        const double h = 1e-5;
        const double slope =
            (wound::unhealed_ratio(curve, t + h) - wound::unhealed_ratio(curve, t - h)) / (2 * h);
        const double rate = curve.delta * curve.gamma * std::pow(t, curve.gamma - 1) +
                            curve.theta / std::hypot(1, curve.theta * t);
        EXPECT_NEAR(slope, (curve.asymptote - wound::unhealed_ratio(curve, t)) * rate, 1e-8);
    }
}

TEST(Healing, FaceDefaultsReproduceThePublishedHalfTime)
{
    EXPECT_NEAR(wound::half_time(H3{}), 8.45, .01); // Yang et al. 2016
    EXPECT_NEAR(wound::closure_day(H3{}), 29.9, .2);
}

TEST(Healing, DayBelowIsTheLastCrossing)
{
    const H3 growing{.2251, 1.316, -.361, 0}; // young mice: grows first
    EXPECT_GT(wound::unhealed_ratio(growing, .5), 1);
    const double half = wound::half_time(growing);
    EXPECT_NEAR(wound::unhealed_ratio(growing, half), .5, 1e-9);
    for (double t = half * 1.001; t < 100; t *= 1.1)
        EXPECT_LT(wound::unhealed_ratio(growing, t), .5);
    EXPECT_TRUE(std::isinf(wound::closure_day(H3{0, 1, 0, 0})));
    EXPECT_TRUE(std::isinf(wound::closure_day(H3{.03, 1.5, 0, .05})));
    EXPECT_NEAR(wound::closure_day(H3{0, 1, 1, 0}), 50, .1); // 1 / (2 theta t) for large t
}

TEST(Healing, ContractionMovesTheBorderAndFaceLeavesARing)
{
    Healing mouse{H3{}, HealingModel::Contraction, .43};
    Healing face;
    for (double day : {0., 3., 8.45, 20., 30., 300.}) {
        const auto m = wound::healing_at(mouse, day);
        const auto f = wound::healing_at(face, day);
        EXPECT_EQ(m.border_ratio, m.unhealed_ratio);
        EXPECT_EQ(f.unhealed_ratio, m.unhealed_ratio);
        EXPECT_GE(f.border_ratio, f.unhealed_ratio);
        EXPECT_DOUBLE_EQ(f.recovery_ratio, 1 - f.unhealed_ratio);
        EXPECT_DOUBLE_EQ(f.depth_scale * f.depth_scale, f.unhealed_ratio);
    }
    EXPECT_NEAR(wound::healing_at(face, 1000).border_ratio, .43, 1e-9);
    EXPECT_EQ(wound::healing_at(face, -5).unhealed_ratio, 1);
}

TEST(Healing, GrowthIsBoundedAndKeepsBedInsideBorder)
{
    const Healing growing{H3{0, 1, -1, 0}, HealingModel::Face, .43};
    for (double day : {0., .1, 1., 1e6}) {
        const auto state = wound::healing_at(growing, day);
        EXPECT_LE(state.unhealed_ratio, wound::largest_drawn_ratio);
        EXPECT_GE(state.border_ratio, state.unhealed_ratio);
        EXPECT_GE(state.recovery_ratio, 0);
        EXPECT_LE(state.depth_scale, 1);
    }
}

TEST(Healing, ValidationNamesFileAndField)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto message = [](H3 curve, double residual) {
        try {
            wound::validate(Healing{curve, HealingModel::Face, residual}, "scene.json");
        } catch (const base::InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(message(H3{}, .43), "");
    EXPECT_NE(message(H3{.1, 0, 0, 0}, .43).find("scene.json: healing.gamma"), std::string::npos);
    EXPECT_NE(message(H3{nan, 1, 0, 0}, .43).find("healing.delta"), std::string::npos);
    EXPECT_NE(message(H3{.1, 1, -1.5, 0}, .43).find("healing.theta"), std::string::npos);
    EXPECT_NE(message(H3{.1, 1, 0, 1}, .43).find("healing.asymptote"), std::string::npos);
    EXPECT_NE(message(H3{}, -1).find("healing.residual_border"), std::string::npos);
}

} // namespace
