// Properties that hold for any tissue, in the shader's single precision: the functions of
// shaders/lib/reflectance.glsl on stacks like those of reflectance_properties_test.cpp. The results are read
// back as 32-bit floats.
#include "tests/shaders/reflectance_case.h"

#include "case_results.hpp"
#include "tests/support/random_tissue.hpp"

using namespace random_tissue;

namespace {

std::vector<optics::Response> evaluate(const std::vector<optics::Stack>& stacks,
                                       optics::ReflectanceModel level)
{
    std::vector<shared::ReflectanceCase> cases;
    std::vector<shared::ReflectanceLayer> layers;
    for (const optics::Stack& stack : stacks) {
        cases.push_back({.model = static_cast<shared::uint>(level),
                         .first = static_cast<shared::uint>(layers.size()),
                         .count = static_cast<shared::uint>(stack.layers.size()),
                         .n_above = static_cast<float>(stack.n_above),
                         .n_below = static_cast<float>(stack.n_below)});
        for (const optics::LayerOptics& layer : stack.layers)
            layers.push_back({.sigma_a = static_cast<float>(layer.sigma_a),
                              .sigma_s_reduced = static_cast<float>(layer.sigma_s_reduced),
                              .g = static_cast<float>(layer.g),
                              .n = static_cast<float>(layer.n),
                              .thickness_mm = static_cast<float>(layer.thickness_mm)});
    }
    std::vector<optics::Response> responses;
    for (const cv::Vec4f& v :
         gpu_test::case_results("reflectance_test.comp", cases.size(), [&](graph::ComputePass& pass) {
             pass.buffer<shared::ReflectanceCase>("CaseBlock", cases);
             pass.buffer<shared::ReflectanceLayer>("LayerBlock", layers);
         }))
        responses.push_back({.r = v[0], .r_without_specular = v[1], .t = v[2]});
    return responses;
}

const std::vector<optics::Stack>& every_kind()
{
    static const std::vector<optics::Stack> stacks = [] {
        std::vector<optics::Stack> result = corners(1e-36f);
        Draw draw(1);
        for (int i = 0; i < 10000; ++i)
            result.push_back(draw.stack());
        return result;
    }();
    return stacks;
}

double difference(const optics::Response& a, const optics::Response& b)
{
    return std::max(std::abs(a.r - b.r), std::abs(a.t - b.t));
}

// Fails where the shader gives different results for the two lists of stacks.
void expect_same(const std::vector<optics::Stack>& a, const std::vector<optics::Stack>& b,
                 optics::ReflectanceModel level, double tolerance)
{
    const std::vector<optics::Response> of_a = evaluate(a, level), of_b = evaluate(b, level);
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_LE(difference(of_a[i], of_b[i]), tolerance)
            << optics::name(level) << " " << text(a[i]) << " / " << text(b[i]);
    }
}

// One operation rounds by 6e-8. About five roundings of each adding step reach R and T; six layers and seven
// boundaries take twelve steps. Measured: 3.3e-6, and 1.1e-5 against the reference, which includes rounding
// of the diffuse Fresnel reflectances.
constexpr double rounding = 4e-6, reference_tolerance = 2e-5;

using ReflectanceInFloat = gpu_test::Test;

} // namespace

TEST_F(ReflectanceInFloat, EqualsTheReference)
{
    for (optics::ReflectanceModel level : bounded) {
        const std::vector<optics::Response> responses = evaluate(every_kind(), level);
        for (std::size_t i = 0; i < responses.size(); ++i) {
            const optics::Response exact = optics::reflectance(every_kind()[i], level);
            ASSERT_LE(difference(responses[i], exact), reference_tolerance)
                << optics::name(level) << " " << text(every_kind()[i]);
            ASSERT_NEAR(responses[i].r_without_specular, exact.r_without_specular, reference_tolerance);
        }
    }
}

TEST_F(ReflectanceInFloat, ReflectsAndTransmitsNoMoreThanArrives)
{
    for (optics::ReflectanceModel level : bounded) {
        const std::vector<optics::Response> responses = evaluate(every_kind(), level);
        for (std::size_t i = 0; i < responses.size(); ++i) {
            const optics::Response& x = responses[i];
            const double r =
                optics::is_the_papers(level) ? x.r_without_specular : x.r; // t: of the light inside
            ASSERT_TRUE(r >= 0 && x.t >= 0 && r + x.t <= 1 + rounding)
                << optics::name(level) << " r " << x.r << " t " << x.t << " of " << text(every_kind()[i]);
        }
    }
}

TEST_F(ReflectanceInFloat, LosesNothingWithoutAbsorption)
{
    std::vector<optics::Stack> stacks;
    for (const optics::Stack& stack : every_kind())
        stacks.push_back(without_absorption(stack));
    for (optics::ReflectanceModel level : two_streams) {
        const std::vector<optics::Response> responses = evaluate(stacks, level);
        for (std::size_t i = 0; i < responses.size(); ++i)
            ASSERT_NEAR(responses[i].r + responses[i].t, 1, rounding)
                << optics::name(level) << " " << text(stacks[i]);
    }
}

TEST_F(ReflectanceInFloat, IsUnchangedByALayerSplitInTwo)
{
    Draw draw(2);
    std::vector<optics::Stack> split;
    for (const optics::Stack& stack : every_kind())
        split.push_back(draw.split(stack));
    for (optics::ReflectanceModel level : two_streams)
        expect_same(split, every_kind(), level, rounding);
}

TEST_F(ReflectanceInFloat, IgnoresALayerWithoutThickness)
{
    Draw draw(3);
    std::vector<optics::Stack> with;
    for (const optics::Stack& stack : every_kind())
        with.push_back(draw.with_empty_layer(stack));
    for (optics::ReflectanceModel level : bounded)
        expect_same(with, every_kind(), level, rounding);
}

TEST_F(ReflectanceInFloat, IsContinuousWhereACoefficientVanishes)
{
    Draw draw(4);
    for (double optics::LayerOptics::*coefficient : coefficients) {
        std::vector<optics::Stack> small = every_kind(), zero = small;
        for (std::size_t i = 0; i < small.size(); ++i) {
            const std::size_t at = draw.place(small[i]);
            small[i].layers[at].*coefficient = 1e-36;
            zero[i].layers[at].*coefficient = 0;
        }
        for (optics::ReflectanceModel level : two_streams)
            expect_same(small, zero, level, rounding);
    }
}

TEST_F(ReflectanceInFloat, IsContinuousEverywhere)
{
    // A coefficient that grows by one part in a thousand moves R and T by no more than that.
    Draw draw(5);
    for (double optics::LayerOptics::*coefficient : coefficients) {
        std::vector<optics::Stack> more = every_kind();
        for (optics::Stack& stack : more)
            stack.layers[draw.place(stack)].*coefficient *= 1.001;
        for (optics::ReflectanceModel level : two_streams)
            expect_same(more, every_kind(), level, 1e-3);
    }
}
