// Adding-doubling and the photon walk against published values and against each other. Photon counts are
// small to keep the tests short; `cicatrix reflect --check` runs the same comparisons with a million photons
// each.
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <random>
#include <string>

#include "tests/random_tissue.hpp"
#include "wound/input_error.hpp"
#include "wound/reflectance.hpp"

using namespace wound;
using testing::HasSubstr;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const RungOptions normal{.incidence = Incidence::Normal}, diffuse{};

RungOptions walk(Incidence incidence, std::uint64_t photons)
{
    return {.incidence = incidence, .photons = photons};
}

Stack one(double a, double b, double g, double n)
{
    return {{{b * (1 - a), b * a * (1 - g), g, n, 1}}, 1, 1};
}
Stack semi_infinite(double a, double n)
{
    return {{{1 - a, a, 0, n, infinity}}, 1, 1};
}
const Stack gardner{{{.1, 1, .9, 1.37, 1}, {.1, 1, 0, 1.37, 1}, {.2, .3, .7, 1.37, 2}}, 1, 1};

Stack random_stack(std::mt19937& random)
{
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    Stack stack{.layers = {}, .n_above = 1, .n_below = uniform(1, 1.5)};
    for (int i = std::uniform_int_distribution(1, 4)(random); i > 0; --i)
        stack.layers.push_back(
            {uniform(.01, 2), uniform(.1, 4), uniform(-.3, .9), uniform(1.3, 1.6), uniform(.05, 1)});
    return stack;
}

// Four standard errors, widened a little for the published values' last digit. t's error is at most the
// binomial one.
void expect_agreement(const Response& walked, double r, double t, double photons)
{
    EXPECT_NEAR(walked.r, r, 4.2 * walked.standard_error);
    EXPECT_NEAR(walked.t, t, 4.2 * std::sqrt(t * (1 - t) / photons) + 1e-9);
}

double total(const Response& x)
{
    double sum = x.r + x.t;
    for (double absorbed : x.absorbed)
        sum += absorbed;
    return sum;
}

} // namespace

TEST(AddingDoubling, HasThePublishedValuesForNormalLight)
{
    const auto check = [](const Stack& stack, double r, double t) {
        const Response x = reflectance(stack, Rung::AddingDoubling, normal);
        EXPECT_NEAR(x.r, r, 2e-4);
        EXPECT_NEAR(x.t, t, 2e-4);
    };
    check({{{1, 9 * .25, .75, 1, .2}}, 1, 1}, .09739, .66096); // van de Hulst 1980
    check({{{1, 9, 0, 1.5, infinity}}, 1, 1}, .2600, 0);       // Giovanelli 1955
    check(gardner, .26224, .09605);                            // adding-doubling of Prahl
    check(one(.9, 1, 0, 1), .26741, .59163);                   // Prahl
    check(one(.99, 10, .76, 1.4), .38425, .31760);
}

// His half spaces are converged to 2e-4 only: his own quadrature with as many angles gives his digits, with
// more it comes to what ours gives with few.
TEST(AddingDoubling, HasThePublishedHalfSpacesWithTheirQuadrature)
{
    for (const auto& [albedo, published] : {std::pair{.8, .18095}, {.95, .38711}, {.99, .63156}}) {
        const Stack stack = semi_infinite(albedo, 1.4);
        const auto r = [&](int angles, Quadrature quadrature) {
            return reflectance(stack, Rung::AddingDoubling,
                               {.incidence = Incidence::Normal, .angles = angles, .quadrature = quadrature})
                .r;
        };
        EXPECT_NEAR(r(8, Quadrature::Slab), published, 5e-5) << albedo;
        const double converged = r(20, Quadrature::Smooth);
        EXPECT_NEAR(r(8, Quadrature::Smooth), converged, 1e-6) << albedo;
        EXPECT_NEAR(r(64, Quadrature::Slab), converged, 2e-6) << albedo;
        EXPECT_GT(std::abs(r(8, Quadrature::Slab) - converged), 1e-4) << albedo;
    }
}

TEST(AddingDoubling, HasThePublishedValuesForDiffuseLight)
{
    const auto check = [](const Stack& stack, double r, double t) {
        const Response x = reflectance(stack, Rung::AddingDoubling, diffuse);
        EXPECT_NEAR(x.r, r, 1e-3);
        EXPECT_NEAR(x.t, t, 1e-3);
    };
    check(one(.9, 1, 0, 1), .35271, .47475);
    check(one(.99, 10, .76, 1.4), .43099, .28563);
}

TEST(AddingDoubling, ReachesThePhotonWalkOnTable1)
{
    // 1e7 photons and more, diffuse light, first-surface reflection excluded; standard error <= .0003.
    const double expected[] = {.697, .207, .166};
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(reflectance(table1().channel(c), Rung::AddingDoubling).r_without_specular, expected[c],
                    1e-3);
}

TEST(AddingDoubling, FewAnglesAreEnough)
{
    std::mt19937 random(3);
    for (int i = 0; i < 12; ++i) {
        const Stack stack = random_stack(random);
        const double converged = reflectance(stack, Rung::AddingDoubling, {.angles = 20}).r;
        EXPECT_NEAR(reflectance(stack, Rung::AddingDoubling, {.angles = 8}).r, converged, 1e-4);
        EXPECT_NEAR(reflectance(stack, Rung::AddingDoubling, {.angles = 4}).r, converged, 1e-3);
    }
}

TEST(AddingDoubling, BearsABackwardPeakAsWellAsAForwardOne)
{
    for (double g : {-.9, -.7, .7, .9}) {
        const Stack stack{{{.3, 2, g, 1.4, 1}}, 1, 1.3};
        const Response few = reflectance(stack, Rung::AddingDoubling, normal);
        const Response many =
            reflectance(stack, Rung::AddingDoubling, {.incidence = Incidence::Normal, .angles = 64});
        EXPECT_NEAR(few.r, many.r, 1e-3) << g;
        EXPECT_NEAR(few.t, many.t, 1e-3) << g;
        expect_agreement(reflectance(stack, Rung::MonteCarlo, walk(Incidence::Normal, 20'000)), many.r,
                         many.t, 20'000);
    }
}

TEST(AddingDoubling, ReturnsAndPassesOnNoMoreThanArrives)
{
    random_tissue::Draw draw(4);
    for (int i = 0; i < 1500; ++i) {
        Stack stack = draw.stack(3);
        if (i % 2 == 0) // next to no absorption
            for (LayerOptics& layer : stack.layers)
                layer.sigma_a = layer.sigma_s_reduced * std::pow(10, -draw.uniform(0, 30));
        for (const RungOptions& light : {normal, diffuse}) {
            const Response x = reflectance(stack, Rung::AddingDoubling, light);
            ASSERT_TRUE(x.r >= 0 && x.t >= 0 && x.r + x.t <= 1 + 1e-11) << random_tissue::text(stack);
            ASSERT_NEAR(total(x), 1, 1e-9) << random_tissue::text(stack);
        }
    }
}

TEST(AddingDoubling, LosesNothingWithoutAbsorption)
{
    std::vector<Stack> stacks;
    random_tissue::Draw draw(5);
    for (int i = 0; i < 1500; ++i)
        stacks.push_back(draw.stack(3));
    const std::vector<Stack> corners = random_tissue::corners(1e-300);
    for (std::size_t i = 0; i < corners.size(); i += 7)
        stacks.push_back(corners[i]);
    for (const Stack& any : stacks) {
        const Stack stack = random_tissue::without_absorption(any);
        for (const RungOptions& light : {normal, diffuse}) {
            const Response x = reflectance(stack, Rung::AddingDoubling, light);
            ASSERT_NEAR(x.r + x.t, 1, 1e-12) << random_tissue::text(stack);
        }
    }
    // A half space that absorbs nothing sends everything back; a little absorption a counts as its root.
    const auto kept_back = [](double a) {
        return 1 - reflectance({{{a, 5.255, .6, 2.87, infinity}}, 1, 1}, Rung::AddingDoubling).r;
    };
    EXPECT_LT(kept_back(0), 1e-10);
    EXPECT_LT(kept_back(1e-300), 1e-10);
    for (double a : {1e-16, 1e-14, 1e-12, 1e-10, 1e-8})
        EXPECT_NEAR(kept_back(a) / std::sqrt(a), 8.30, .05) << a;
}

TEST(AddingDoubling, DoesNotSeeALayerSplitInTwo)
{
    random_tissue::Draw draw(6);
    for (int i = 0; i < 1500; ++i) {
        const Stack whole = draw.stack(2), split = draw.split(whole);
        for (const RungOptions& light : {normal, diffuse}) {
            const Response a = reflectance(whole, Rung::AddingDoubling, light);
            const Response b = reflectance(split, Rung::AddingDoubling, light);
            ASSERT_NEAR(a.r, b.r, 1e-9) << random_tissue::text(split);
            ASSERT_NEAR(a.t, b.t, 1e-9) << random_tissue::text(split);
        }
    }
}

TEST(TwoStream, IsWithinTwoHundredthsOfTheTruthOnTable1)
{
    double eddington = 0, calibrated = 0;
    const SkinLayers stacks[] = {table1(.2, 1, 4), table1(.2, 4, 9), table1(.1, 2.5, 6)};
    for (const SkinLayers& tissue : stacks)
        for (std::size_t c = 0; c < 3; ++c) {
            const double truth = reflectance(tissue.channel(c), Rung::AddingDoubling).r_without_specular;
            eddington +=
                std::pow(reflectance(tissue.channel(c), Rung::TwoStream).r_without_specular - truth, 2) / 9;
            calibrated +=
                std::pow(reflectance(tissue.channel(c), Rung::Calibrated).r_without_specular - truth, 2) / 9;
        }
    EXPECT_LT(std::sqrt(eddington), .02);
    EXPECT_LT(std::sqrt(calibrated), .01);
}

TEST(MonteCarlo, HasThePublishedValues)
{
    const auto check = [](const Stack& stack, Incidence incidence, double r, double t) {
        expect_agreement(reflectance(stack, Rung::MonteCarlo, walk(incidence, 40'000)), r, t, 40'000);
    };
    check({{{1, 9 * .25, .75, 1, .2}}, 1, 1}, Incidence::Normal, .09739, .66096);
    check({{{1, 9, 0, 1.5, infinity}}, 1, 1}, Incidence::Normal, .2600, 0);
    check(gardner, Incidence::Normal, .26224, .09605);
    check(one(.9, 1, 0, 1), Incidence::Normal, .26741, .59163);
    check(one(.9, 1, 0, 1), Incidence::Diffuse, .35271, .47475);
    check(one(.99, 10, .76, 1.4), Incidence::Normal, .38425, .31760);
    check(one(.99, 10, .76, 1.4), Incidence::Diffuse, .43099, .28563);
    for (const auto& [a, r] : {std::pair{.8, .18095}, {.95, .38711}, {.99, .63156}})
        check(semi_infinite(a, 1.4), Incidence::Normal, r, 0);
}

TEST(MonteCarlo, AgreesWithAddingDoublingOnRandomStacks)
{
    std::mt19937 random(5);
    for (int i = 0; i < 12; ++i) {
        const Stack stack = random_stack(random);
        for (Incidence incidence : {Incidence::Normal, Incidence::Diffuse}) {
            const Response exact = reflectance(stack, Rung::AddingDoubling, {.incidence = incidence});
            const Response walked = reflectance(stack, Rung::MonteCarlo, walk(incidence, 20'000));
            EXPECT_NEAR(walked.r, exact.r, 4.2 * walked.standard_error);
            for (std::size_t l = 0; l < stack.layers.size(); ++l)
                EXPECT_NEAR(walked.absorbed[l], exact.absorbed[l], .02);
            EXPECT_NEAR(total(walked), 1, 2e-3); // roulette conserves on average only
        }
    }
}

TEST(MonteCarlo, DoesNotDependOnTheNumberOfThreads)
{
    RungOptions options{.photons = 35'000, .seed = 9, .threads = 1};
    const Response alone = reflectance(gardner, Rung::MonteCarlo, options);
    options.threads = 5;
    const Response shared = reflectance(gardner, Rung::MonteCarlo, options);
    EXPECT_EQ(alone.r, shared.r);
    EXPECT_EQ(alone.t, shared.t);
    EXPECT_EQ(alone.absorbed, shared.absorbed);
    options.seed = 10;
    EXPECT_NE(reflectance(gardner, Rung::MonteCarlo, options).r, alone.r);
}

TEST(MonteCarlo, StandardErrorIsTheSpreadOfIndependentRuns)
{
    double sum = 0, squares = 0, stated = 0;
    const int runs = 40;
    for (int i = 0; i < runs; ++i) {
        const Response x = reflectance(one(.9, 1, 0, 1.4), Rung::MonteCarlo,
                                       {.photons = 2000, .seed = static_cast<std::uint64_t>(i)});
        sum += x.r;
        squares += x.r * x.r;
        stated += x.standard_error / runs;
    }
    const double spread = std::sqrt((squares - sum * sum / runs) / (runs - 1));
    EXPECT_NEAR(spread / stated, 1, .35); // chi with 39 degrees of freedom: three sigma
}

TEST(MonteCarlo, ReportsProgress)
{
    std::vector<double> shares;
    RungOptions options{.photons = 30'000};
    options.progress = [&](double share) { shares.push_back(share); };
    reflectance(one(.9, 1, 0, 1), Rung::MonteCarlo, options);
    ASSERT_EQ(shares.size(), 3u);
    EXPECT_DOUBLE_EQ(shares.back(), 1);
}

TEST(MonteCarlo, RefusesWalksThatWouldTakeHours)
{
    const auto refusal = [](double a, double s, double g, double thickness_mm, std::uint64_t photons) {
        try {
            reflectance({{{a, s, g, 1.4, thickness_mm}}, 1, 1}, Rung::MonteCarlo, {.photons = photons});
        } catch (const cicatrix::InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(refusal(0, 10, 0, infinity, 1), HasSubstr("nothing ends a photon's walk"));
    EXPECT_THAT(
        refusal(0, 9000, .99, 1, 1'000'000),
        HasSubstr(
            "1000000 photons of about 7e+06 steps each would walk for hours; use 10000 photons or fewer"));
    EXPECT_THAT(refusal(0, 90, .99, 1, 2'000'000),
                HasSubstr("use 1000000 photons or fewer, or adding-doubling"));
    EXPECT_EQ(refusal(0, 90, .99, 1, 20), "");
    EXPECT_THAT(refusal(1e-12, 10, 0, infinity, 1'000'000), HasSubstr("would walk for hours"));
    EXPECT_EQ(refusal(1, 10, 0, infinity, 1000), ""); // absorption ends it
    EXPECT_THAT(refusal(1, 10, 0, infinity, 100'000'000'000), HasSubstr("photons or fewer"));
    EXPECT_EQ(refusal(0, 0, 0, infinity, 1000), ""); // clear
}

TEST(NumericalRungs, TakeExactFresnelWhateverTheAnalyticOnesTake)
{
    const Stack stack{{{1e-3, 2, .6, 3, 1}}, 1, 1};
    for (Rung rung : {Rung::MonteCarlo, Rung::AddingDoubling}) {
        RungOptions options{.photons = 20'000};
        const Response exact = reflectance(stack, rung, options);
        options.fresnel = DiffuseFresnel::Polynomial;
        const Response same = reflectance(stack, rung, options);
        EXPECT_EQ(same.r, exact.r) << name(rung);
        EXPECT_NEAR(total(same), 1, .01) << name(rung);
    }
}
