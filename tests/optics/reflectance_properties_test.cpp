// Properties that hold for any tissue, in double precision: thousands of random stacks and all corners, for
// every model that guarantees them. reflectance_float_test.cpp: the same in the shader's single precision.
#include <gtest/gtest.h>
#include <numeric>

#include "tests/support/random_tissue.hpp"

using namespace random_tissue;

namespace {

const std::vector<optics::Stack>& every_kind()
{
    static const std::vector<optics::Stack> stacks = [] {
        std::vector<optics::Stack> result = corners(1e-300);
        Draw draw(1);
        for (int i = 0; i < 10000; ++i)
            result.push_back(draw.stack());
        return result;
    }();
    return stacks;
}

// Calls check(stack, model, light) for all combinations, until one fails.
template <std::size_t count, typename Check>
void for_each_case(const optics::ReflectanceModel (&models)[count], const Check& check)
{
    for (const optics::Stack& stack : every_kind())
        for (optics::ReflectanceModel model : models)
            for (optics::Incidence incidence : {optics::Incidence::Diffuse, optics::Incidence::Normal}) {
                check(stack, model, optics::ReflectanceOptions{.incidence = incidence});
                if (testing::Test::HasFatalFailure())
                    return;
            }
}

bool same(const optics::Response& a, const optics::Response& b, double tolerance)
{
    return std::abs(a.r - b.r) <= tolerance && std::abs(a.t - b.t) <= tolerance;
}

} // namespace

TEST(BoundedModels, ReflectAndTransmitNoMoreThanArrives)
{
    for_each_case(bounded, [](const optics::Stack& stack, optics::ReflectanceModel model,
                              const optics::ReflectanceOptions& light) {
        const optics::Response x = optics::reflectance(stack, model, light);
        const double r =
            optics::is_the_papers(model) ? x.r_without_specular : x.r; // t is of the light inside
        ASSERT_TRUE(r >= 0 && x.r_without_specular >= 0 && x.t >= 0 && r + x.t <= 1 + 1e-14)
            << optics::name(model) << " r " << x.r << " t " << x.t << " of " << text(stack);
    });
}

TEST(BoundedModels, IgnoreALayerWithoutThickness)
{
    Draw draw(2);
    for_each_case(bounded, [&](const optics::Stack& without, optics::ReflectanceModel model,
                               const optics::ReflectanceOptions& light) {
        const optics::Stack with = draw.with_empty_layer(without);
        ASSERT_TRUE(
            same(optics::reflectance(with, model, light), optics::reflectance(without, model, light), 1e-15))
            << optics::name(model) << " " << text(with);
    });
}

TEST(TwoStream, LosesNothingWithoutAbsorption)
{
    for_each_case(two_streams, [](const optics::Stack& any, optics::ReflectanceModel model,
                                  const optics::ReflectanceOptions& light) {
        const optics::Stack stack = without_absorption(any);
        const optics::Response x = optics::reflectance(stack, model, light);
        ASSERT_NEAR(x.r + x.t, 1, 1e-12) << optics::name(model) << " " << text(stack);
    });
}

TEST(TwoStream, AccountsForAllLight)
{
    for_each_case(two_streams, [](const optics::Stack& stack, optics::ReflectanceModel model,
                                  const optics::ReflectanceOptions& light) {
        const optics::Response x = optics::reflectance(stack, model, light);
        const double sum = std::accumulate(x.absorbed.begin(), x.absorbed.end(), x.r + x.t);
        ASSERT_NEAR(sum, 1, 1e-12) << optics::name(model) << " " << text(stack);
    });
}

TEST(TwoStream, IsUnchangedByALayerSplitInTwo)
{
    Draw draw(3);
    for_each_case(two_streams, [&](const optics::Stack& whole, optics::ReflectanceModel model,
                                   const optics::ReflectanceOptions& light) {
        const optics::Stack split = draw.split(whole);
        ASSERT_TRUE(
            same(optics::reflectance(whole, model, light), optics::reflectance(split, model, light), 1e-12))
            << optics::name(model) << " " << text(split);
    });
}

TEST(TwoStream, IsContinuousWhereACoefficientVanishes)
{
    Draw draw(4);
    for_each_case(two_streams, [&](const optics::Stack& stack, optics::ReflectanceModel model,
                                   const optics::ReflectanceOptions& light) {
        for (double optics::LayerOptics::*coefficient : coefficients) {
            optics::Stack small = stack, zero = stack;
            const std::size_t at = draw.place(stack);
            small.layers[at].*coefficient = 1e-60;
            zero.layers[at].*coefficient = 0;
            ASSERT_TRUE(same(optics::reflectance(small, model, light),
                             optics::reflectance(zero, model, light), 1e-12))
                << optics::name(model) << " " << text(small);
        }
    });
}

TEST(TwoStream, IsContinuousEverywhere)
{
    // A coefficient that grows by one part in a million moves R and T by no more than that.
    Draw draw(5);
    for_each_case(two_streams, [&](const optics::Stack& stack, optics::ReflectanceModel model,
                                   const optics::ReflectanceOptions& light) {
        for (double optics::LayerOptics::*coefficient : coefficients) {
            optics::Stack more = stack;
            more.layers[draw.place(stack)].*coefficient *= 1 + 1e-6;
            ASSERT_TRUE(
                same(optics::reflectance(more, model, light), optics::reflectance(stack, model, light), 1e-6))
                << optics::name(model) << " " << text(more);
        }
    });
}
