// What must hold for any tissue, in double precision: thousands of random stacks and all corners, for every
// rung that promises it. The same in the shader's single precision: reflectance_float_test.cpp.
#include <gtest/gtest.h>
#include <numeric>

#include "tests/random_tissue.hpp"

using namespace wound;
using namespace random_tissue;

namespace {

const std::vector<Stack>& every_kind()
{
    static const std::vector<Stack> stacks = [] {
        std::vector<Stack> result = corners(1e-300);
        Draw draw(1);
        for (int i = 0; i < 10000; ++i)
            result.push_back(draw.stack());
        return result;
    }();
    return stacks;
}

// Calls check(stack, rung, light) for all of them, until one fails.
template <std::size_t count, typename Check>
void for_each_case(const Rung (&rungs)[count], const Check& check)
{
    for (const Stack& stack : every_kind())
        for (Rung rung : rungs)
            for (Incidence incidence : {Incidence::Diffuse, Incidence::Normal}) {
                check(stack, rung, RungOptions{.incidence = incidence});
                if (testing::Test::HasFatalFailure())
                    return;
            }
}

bool same(const Response& a, const Response& b, double tolerance)
{
    return std::abs(a.r - b.r) <= tolerance && std::abs(a.t - b.t) <= tolerance;
}

} // namespace

TEST(BoundedRungs, ReturnAndPassOnNoMoreThanArrives)
{
    for_each_case(bounded, [](const Stack& stack, Rung rung, const RungOptions& light) {
        const Response x = reflectance(stack, rung, light);
        ASSERT_TRUE(x.r >= 0 && x.r_without_specular >= 0 && x.t >= 0 && x.r + x.t <= 1 + 1e-14)
            << name(rung) << " r " << x.r << " t " << x.t << " of " << text(stack);
    });
}

TEST(BoundedRungs, SeeNothingInALayerWithoutThickness)
{
    Draw draw(2);
    for_each_case(bounded, [&](const Stack& without, Rung rung, const RungOptions& light) {
        const Stack with = draw.with_empty_layer(without);
        ASSERT_TRUE(same(reflectance(with, rung, light), reflectance(without, rung, light), 1e-15))
            << name(rung) << " " << text(with);
    });
}

TEST(TwoStream, LosesNothingWithoutAbsorption)
{
    for_each_case(two_streams, [](const Stack& any, Rung rung, const RungOptions& light) {
        const Stack stack = without_absorption(any);
        const Response x = reflectance(stack, rung, light);
        ASSERT_NEAR(x.r + x.t, 1, 1e-12) << name(rung) << " " << text(stack);
    });
}

TEST(TwoStream, AccountsForAllLight)
{
    for_each_case(two_streams, [](const Stack& stack, Rung rung, const RungOptions& light) {
        const Response x = reflectance(stack, rung, light);
        const double sum = std::accumulate(x.absorbed.begin(), x.absorbed.end(), x.r + x.t);
        ASSERT_NEAR(sum, 1, 1e-12) << name(rung) << " " << text(stack);
    });
}

TEST(TwoStream, DoesNotSeeALayerSplitInTwo)
{
    Draw draw(3);
    for_each_case(two_streams, [&](const Stack& whole, Rung rung, const RungOptions& light) {
        const Stack split = draw.split(whole);
        ASSERT_TRUE(same(reflectance(whole, rung, light), reflectance(split, rung, light), 1e-12))
            << name(rung) << " " << text(split);
    });
}

TEST(TwoStream, MakesNoStepWhereACoefficientVanishes)
{
    Draw draw(4);
    for_each_case(two_streams, [&](const Stack& stack, Rung rung, const RungOptions& light) {
        for (double LayerOptics::*coefficient : coefficients) {
            Stack small = stack, zero = stack;
            const std::size_t at = draw.place(stack);
            small.layers[at].*coefficient = 1e-60;
            zero.layers[at].*coefficient = 0;
            ASSERT_TRUE(same(reflectance(small, rung, light), reflectance(zero, rung, light), 1e-12))
                << name(rung) << " " << text(small);
        }
    });
}

TEST(TwoStream, MakesNoStepAnywhere)
{
    // A coefficient that grows by one part in a million moves R and T by no more than that.
    Draw draw(5);
    for_each_case(two_streams, [&](const Stack& stack, Rung rung, const RungOptions& light) {
        for (double LayerOptics::*coefficient : coefficients) {
            Stack more = stack;
            more.layers[draw.place(stack)].*coefficient *= 1 + 1e-6;
            ASSERT_TRUE(same(reflectance(more, rung, light), reflectance(stack, rung, light), 1e-6))
                << name(rung) << " " << text(more);
        }
    });
}
