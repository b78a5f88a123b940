// Adding-doubling and the photon walk against published values and against each other. Photon counts are
// small to keep the tests short; `cicatrix reflect --check` runs the same comparisons with a million photons
// each.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "wound/input_error.hpp"
#include "wound/reflectance.hpp"

using namespace wound;

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

TEST(AddingDoubling, KeepsBoundsAndAccountsForAllLight)
{
    std::mt19937 random(4);
    const auto log_uniform = [&](double low, double high) {
        return std::exp(std::uniform_real_distribution(std::log(low), std::log(high))(random));
    };
    for (int i = 0; i < 300; ++i) {
        Stack stack = random_stack(random);
        for (LayerOptics& layer : stack.layers) {
            layer.sigma_a = i % 3 == 0 ? 0 : log_uniform(1e-9, 1e6);
            layer.sigma_s_reduced = i % 5 == 0 ? 0 : log_uniform(1e-9, 1e6);
            layer.thickness_mm = i % 7 == 0 ? infinity : log_uniform(1e-9, 1e9);
            layer.g = std::uniform_real_distribution(-1.0, 1.0)(random);
        }
        for (const RungOptions& light : {normal, diffuse}) {
            const Response x = reflectance(stack, Rung::AddingDoubling, light);
            ASSERT_TRUE(x.r >= -1e-8 && x.t >= -1e-8 && x.r + x.t <= 1 + 1e-8) << x.r << " " << x.t;
            ASSERT_NEAR(total(x), 1, 1e-8);
        }
    }
}

TEST(AddingDoubling, DoesNotSeeALayerSplitInTwo)
{
    Stack split = gardner;
    split.layers.insert(split.layers.begin(), split.layers[0]);
    split.layers[0].thickness_mm = .3;
    split.layers[1].thickness_mm = .7;
    EXPECT_NEAR(reflectance(split, Rung::AddingDoubling).r, reflectance(gardner, Rung::AddingDoubling).r,
                1e-9);
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

TEST(MonteCarlo, ReportsProgressAndRefusesEndlessWalks)
{
    std::vector<double> shares;
    RungOptions options{.photons = 30'000};
    options.progress = [&](double share) { shares.push_back(share); };
    reflectance(one(.9, 1, 0, 1), Rung::MonteCarlo, options);
    ASSERT_EQ(shares.size(), 3u);
    EXPECT_DOUBLE_EQ(shares.back(), 1);
    EXPECT_THROW(reflectance({{{0, 10, 0, 1.4, infinity}}, 1, 1}, Rung::MonteCarlo), cicatrix::InputError);
}
