// Adding-doubling and the photon walk against published values and against each other. Photon counts are
// small to keep the tests short; `cicatrix reflect --check` runs the same comparisons with a million photons
// each.
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <random>
#include <string>

#include "base/input_error.hpp"
#include "tests/support/random_tissue.hpp"
#include "wound/optics/reflectance.hpp"

using testing::HasSubstr;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const optics::ReflectanceOptions normal{.incidence = optics::Incidence::Normal}, diffuse{};

optics::ReflectanceOptions walk(optics::Incidence incidence, std::uint64_t photons)
{
    return {.incidence = incidence, .photons = photons};
}

optics::Stack one(double a, double b, double g, double n)
{
    return {{{b * (1 - a), b * a * (1 - g), g, n, 1}}, 1, 1};
}
optics::Stack semi_infinite(double a, double n)
{
    return {{{1 - a, a, 0, n, infinity}}, 1, 1};
}
const optics::Stack gardner{{{.1, 1, .9, 1.37, 1}, {.1, 1, 0, 1.37, 1}, {.2, .3, .7, 1.37, 2}}, 1, 1};

optics::Stack random_stack(std::mt19937& random)
{
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    optics::Stack stack{.layers = {}, .n_above = 1, .n_below = uniform(1, 1.5)};
    for (int i = std::uniform_int_distribution(1, 4)(random); i > 0; --i)
        stack.layers.push_back(
            {uniform(.01, 2), uniform(.1, 4), uniform(-.3, .9), uniform(1.3, 1.6), uniform(.05, 1)});
    return stack;
}

// Four standard errors, widened a little for the last digit of the published values. The error of t is at
// most the binomial one.
void expect_agreement(const optics::Response& walked, double r, double t, double photons)
{
    EXPECT_NEAR(walked.r, r, 4.2 * walked.standard_error);
    EXPECT_NEAR(walked.t, t, 4.2 * std::sqrt(t * (1 - t) / photons) + 1e-9);
}

double total(const optics::Response& x)
{
    double sum = x.r + x.t;
    for (double absorbed : x.absorbed)
        sum += absorbed;
    return sum;
}

} // namespace

TEST(AddingDoubling, HasThePublishedValuesForNormalLight)
{
    const auto check = [](const optics::Stack& stack, double r, double t) {
        const optics::Response x =
            optics::reflectance(stack, optics::ReflectanceModel::AddingDoubling, normal);
        EXPECT_NEAR(x.r, r, 2e-4);
        EXPECT_NEAR(x.t, t, 2e-4);
    };
    check({{{1, 9 * .25, .75, 1, .2}}, 1, 1}, .09739, .66096); // van de Hulst 1980
    check({{{1, 9, 0, 1.5, infinity}}, 1, 1}, .2600, 0);       // Giovanelli 1955
    check(gardner, .26224, .09605);                            // adding-doubling of Prahl
    check(one(.9, 1, 0, 1), .26741, .59163);                   // Prahl
    check(one(.99, 10, .76, 1.4), .38425, .31760);
}

// The published half spaces are converged to 2e-4 only: their quadrature (Slab) with 8 angles gives the
// published digits, and with 64 angles what the smooth quadrature gives with 8.
TEST(AddingDoubling, HasThePublishedHalfSpacesWithTheirQuadrature)
{
    for (const auto& [albedo, published] : {std::pair{.8, .18095}, {.95, .38711}, {.99, .63156}}) {
        const optics::Stack stack = semi_infinite(albedo, 1.4);
        const auto r = [&](int angles, optics::Quadrature quadrature) {
            return optics::reflectance(
                       stack, optics::ReflectanceModel::AddingDoubling,
                       {.incidence = optics::Incidence::Normal, .angles = angles, .quadrature = quadrature})
                .r;
        };
        EXPECT_NEAR(r(8, optics::Quadrature::Slab), published, 5e-5) << albedo;
        const double converged = r(20, optics::Quadrature::Smooth);
        EXPECT_NEAR(r(8, optics::Quadrature::Smooth), converged, 1e-6) << albedo;
        EXPECT_NEAR(r(64, optics::Quadrature::Slab), converged, 2e-6) << albedo;
        EXPECT_GT(std::abs(r(8, optics::Quadrature::Slab) - converged), 1e-4) << albedo;
    }
}

TEST(AddingDoubling, HasThePublishedValuesForDiffuseLight)
{
    const auto check = [](const optics::Stack& stack, double r, double t) {
        const optics::Response x =
            optics::reflectance(stack, optics::ReflectanceModel::AddingDoubling, diffuse);
        EXPECT_NEAR(x.r, r, 1e-3);
        EXPECT_NEAR(x.t, t, 1e-3);
    };
    check(one(.9, 1, 0, 1), .35271, .47475);
    check(one(.99, 10, .76, 1.4), .43099, .28563);
}

TEST(AddingDoubling, AgreesWithThePhotonWalkOnTable1)
{
    // 1e7 photons and more, diffuse light, first-surface reflection excluded; standard error <= .0003.
    const double expected[] = {.697, .207, .166};
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(optics::reflectance(optics::table1().channel(c), optics::ReflectanceModel::AddingDoubling)
                        .r_without_specular,
                    expected[c], 1e-3);
}

TEST(AddingDoubling, FewAnglesAreEnough)
{
    std::mt19937 random(3);
    for (int i = 0; i < 12; ++i) {
        const optics::Stack stack = random_stack(random);
        const double converged =
            optics::reflectance(stack, optics::ReflectanceModel::AddingDoubling, {.angles = 20}).r;
        EXPECT_NEAR(optics::reflectance(stack, optics::ReflectanceModel::AddingDoubling, {.angles = 8}).r,
                    converged, 1e-4);
        EXPECT_NEAR(optics::reflectance(stack, optics::ReflectanceModel::AddingDoubling, {.angles = 4}).r,
                    converged, 1e-3);
    }
}

TEST(AddingDoubling, HandlesBackwardAndForwardPeaks)
{
    for (double g : {-.9, -.7, .7, .9}) {
        const optics::Stack stack{{{.3, 2, g, 1.4, 1}}, 1, 1.3};
        const optics::Response few =
            optics::reflectance(stack, optics::ReflectanceModel::AddingDoubling, normal);
        const optics::Response many =
            optics::reflectance(stack, optics::ReflectanceModel::AddingDoubling,
                                {.incidence = optics::Incidence::Normal, .angles = 64});
        EXPECT_NEAR(few.r, many.r, 1e-3) << g;
        EXPECT_NEAR(few.t, many.t, 1e-3) << g;
        expect_agreement(optics::reflectance(stack, optics::ReflectanceModel::MonteCarlo,
                                             walk(optics::Incidence::Normal, 20'000)),
                         many.r, many.t, 20'000);
    }
}

TEST(AddingDoubling, ReflectsAndTransmitsNoMoreThanArrives)
{
    random_tissue::Draw draw(4);
    for (int i = 0; i < 1500; ++i) {
        optics::Stack stack = draw.stack(3);
        if (i % 2 == 0) // next to no absorption
            for (optics::LayerOptics& layer : stack.layers)
                layer.sigma_a = layer.sigma_s_reduced * std::pow(10, -draw.uniform(0, 30));
        for (const optics::ReflectanceOptions& light : {normal, diffuse}) {
            const optics::Response x =
                optics::reflectance(stack, optics::ReflectanceModel::AddingDoubling, light);
            ASSERT_TRUE(x.r >= 0 && x.t >= 0 && x.r + x.t <= 1 + 1e-11) << random_tissue::text(stack);
            ASSERT_NEAR(total(x), 1, 1e-9) << random_tissue::text(stack);
        }
    }
}

TEST(AddingDoubling, LosesNothingWithoutAbsorption)
{
    std::vector<optics::Stack> stacks;
    random_tissue::Draw draw(5);
    for (int i = 0; i < 1500; ++i)
        stacks.push_back(draw.stack(3));
    const std::vector<optics::Stack> corners = random_tissue::corners(1e-300);
    for (std::size_t i = 0; i < corners.size(); i += 7)
        stacks.push_back(corners[i]);
    for (const optics::Stack& any : stacks) {
        const optics::Stack stack = random_tissue::without_absorption(any);
        for (const optics::ReflectanceOptions& light : {normal, diffuse}) {
            const optics::Response x =
                optics::reflectance(stack, optics::ReflectanceModel::AddingDoubling, light);
            ASSERT_NEAR(x.r + x.t, 1, 1e-12) << random_tissue::text(stack);
        }
    }
    // A half space without absorption reflects everything; with a little absorption a, the loss is ~ sqrt(a).
    const auto loss = [](double a) {
        return 1 - optics::reflectance({{{a, 5.255, .6, 2.87, infinity}}, 1, 1},
                                       optics::ReflectanceModel::AddingDoubling)
                       .r;
    };
    EXPECT_LT(loss(0), 1e-10);
    EXPECT_LT(loss(1e-300), 1e-10);
    for (double a : {1e-16, 1e-14, 1e-12, 1e-10, 1e-8})
        EXPECT_NEAR(loss(a) / std::sqrt(a), 8.30, .05) << a;
}

TEST(AddingDoubling, IsUnchangedByALayerSplitInTwo)
{
    random_tissue::Draw draw(6);
    for (int i = 0; i < 1500; ++i) {
        const optics::Stack whole = draw.stack(2), split = draw.split(whole);
        for (const optics::ReflectanceOptions& light : {normal, diffuse}) {
            const optics::Response a =
                optics::reflectance(whole, optics::ReflectanceModel::AddingDoubling, light);
            const optics::Response b =
                optics::reflectance(split, optics::ReflectanceModel::AddingDoubling, light);
            ASSERT_NEAR(a.r, b.r, 1e-9) << random_tissue::text(split);
            ASSERT_NEAR(a.t, b.t, 1e-9) << random_tissue::text(split);
        }
    }
}

TEST(TwoStream, IsWithinTwoHundredthsOfTheTruthOnTable1)
{
    double eddington = 0, calibrated = 0;
    const optics::SkinLayers stacks[] = {optics::table1(.2, 1, 4), optics::table1(.2, 4, 9),
                                         optics::table1(.1, 2.5, 6)};
    for (const optics::SkinLayers& tissue : stacks)
        for (std::size_t c = 0; c < 3; ++c) {
            const double truth =
                optics::reflectance(tissue.channel(c), optics::ReflectanceModel::AddingDoubling)
                    .r_without_specular;
            eddington += std::pow(optics::reflectance(tissue.channel(c), optics::ReflectanceModel::TwoStream)
                                          .r_without_specular -
                                      truth,
                                  2) /
                         9;
            calibrated +=
                std::pow(optics::reflectance(tissue.channel(c), optics::ReflectanceModel::Calibrated)
                                 .r_without_specular -
                             truth,
                         2) /
                9;
        }
    EXPECT_LT(std::sqrt(eddington), .02);
    EXPECT_LT(std::sqrt(calibrated), .01);
}

TEST(MonteCarlo, HasThePublishedValues)
{
    const auto check = [](const optics::Stack& stack, optics::Incidence incidence, double r, double t) {
        expect_agreement(
            optics::reflectance(stack, optics::ReflectanceModel::MonteCarlo, walk(incidence, 40'000)), r, t,
            40'000);
    };
    check({{{1, 9 * .25, .75, 1, .2}}, 1, 1}, optics::Incidence::Normal, .09739, .66096);
    check({{{1, 9, 0, 1.5, infinity}}, 1, 1}, optics::Incidence::Normal, .2600, 0);
    check(gardner, optics::Incidence::Normal, .26224, .09605);
    check(one(.9, 1, 0, 1), optics::Incidence::Normal, .26741, .59163);
    check(one(.9, 1, 0, 1), optics::Incidence::Diffuse, .35271, .47475);
    check(one(.99, 10, .76, 1.4), optics::Incidence::Normal, .38425, .31760);
    check(one(.99, 10, .76, 1.4), optics::Incidence::Diffuse, .43099, .28563);
    for (const auto& [a, r] : {std::pair{.8, .18095}, {.95, .38711}, {.99, .63156}})
        check(semi_infinite(a, 1.4), optics::Incidence::Normal, r, 0);
}

TEST(MonteCarlo, AgreesWithAddingDoublingOnRandomStacks)
{
    std::mt19937 random(5);
    for (int i = 0; i < 12; ++i) {
        const optics::Stack stack = random_stack(random);
        for (optics::Incidence incidence : {optics::Incidence::Normal, optics::Incidence::Diffuse}) {
            const optics::Response exact = optics::reflectance(
                stack, optics::ReflectanceModel::AddingDoubling, {.incidence = incidence});
            const optics::Response walked =
                optics::reflectance(stack, optics::ReflectanceModel::MonteCarlo, walk(incidence, 20'000));
            EXPECT_NEAR(walked.r, exact.r, 4.2 * walked.standard_error);
            for (std::size_t l = 0; l < stack.layers.size(); ++l)
                EXPECT_NEAR(walked.absorbed[l], exact.absorbed[l], .02);
            EXPECT_NEAR(total(walked), 1, 2e-3); // roulette conserves on average only
        }
    }
}

TEST(MonteCarlo, DoesNotDependOnTheNumberOfThreads)
{
    optics::ReflectanceOptions options{.photons = 35'000, .seed = 9, .threads = 1};
    const optics::Response alone =
        optics::reflectance(gardner, optics::ReflectanceModel::MonteCarlo, options);
    options.threads = 5;
    const optics::Response shared =
        optics::reflectance(gardner, optics::ReflectanceModel::MonteCarlo, options);
    EXPECT_EQ(alone.r, shared.r);
    EXPECT_EQ(alone.t, shared.t);
    EXPECT_EQ(alone.absorbed, shared.absorbed);
    options.seed = 10;
    EXPECT_NE(optics::reflectance(gardner, optics::ReflectanceModel::MonteCarlo, options).r, alone.r);
}

TEST(MonteCarlo, StandardErrorIsTheSpreadOfIndependentRuns)
{
    double sum = 0, squares = 0, stated = 0;
    const int runs = 40;
    for (int i = 0; i < runs; ++i) {
        const optics::Response x =
            optics::reflectance(one(.9, 1, 0, 1.4), optics::ReflectanceModel::MonteCarlo,
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
    optics::ReflectanceOptions options{.photons = 30'000};
    options.progress = [&](double share) { shares.push_back(share); };
    optics::reflectance(one(.9, 1, 0, 1), optics::ReflectanceModel::MonteCarlo, options);
    ASSERT_EQ(shares.size(), 3u);
    EXPECT_DOUBLE_EQ(shares.back(), 1);
}

TEST(MonteCarlo, RefusesWalksThatWouldTakeHours)
{
    const auto refusal = [](double a, double s, double g, double thickness_mm, std::uint64_t photons) {
        try {
            optics::reflectance({{{a, s, g, 1.4, thickness_mm}}, 1, 1}, optics::ReflectanceModel::MonteCarlo,
                                {.photons = photons});
        } catch (const base::InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(refusal(0, 10, 0, infinity, 1), HasSubstr("a photon's walk through an infinite layer"));
    EXPECT_THAT(
        refusal(0, 9000, .99, 1, 1'000'000),
        HasSubstr(
            "1000000 photons of about 7e+06 steps each would take hours; use 10000 photons or fewer"));
    EXPECT_THAT(refusal(0, 90, .99, 1, 2'000'000),
                HasSubstr("use 1000000 photons or fewer, or adding-doubling"));
    EXPECT_EQ(refusal(0, 90, .99, 1, 20), "");
    EXPECT_THAT(refusal(1e-12, 10, 0, infinity, 1'000'000), HasSubstr("would take hours"));
    EXPECT_EQ(refusal(1, 10, 0, infinity, 1000), ""); // absorption ends it
    EXPECT_THAT(refusal(1, 10, 0, infinity, 100'000'000'000), HasSubstr("photons or fewer"));
    EXPECT_EQ(refusal(0, 0, 0, infinity, 1000), ""); // clear
}

TEST(NumericalModels, UseExactFresnelWhateverTheAnalyticModelsUse)
{
    const optics::Stack stack{{{1e-3, 2, .6, 3, 1}}, 1, 1};
    for (optics::ReflectanceModel model :
         {optics::ReflectanceModel::MonteCarlo, optics::ReflectanceModel::AddingDoubling})
    {
        optics::ReflectanceOptions options{.photons = 20'000};
        const optics::Response exact = optics::reflectance(stack, model, options);
        options.fresnel = optics::DiffuseFresnel::Polynomial;
        const optics::Response same = optics::reflectance(stack, model, options);
        EXPECT_EQ(same.r, exact.r) << optics::name(model);
        EXPECT_NEAR(total(same), 1, .01) << optics::name(model);
    }
}
