// The float formulas of shaders/lib against the double-precision reference in wound/, over their whole range.
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "shading_cases.hpp"
#include "wound/optics/dipole.hpp"
#include "wound/optics/specular.hpp"
#include "wound/optics/transport.hpp"

namespace {

using namespace shading_cases;
using ShadingOnGpu = gpu_test::Test;

} // namespace

// The lobe's exponent is (|h| / (slope h.z))^2. Rounding h by one float step changes it more for a narrower
// slope and a lower h. The test allows the effect of 2 steps in either component of h, plus 1e-5.
TEST_F(ShadingOnGpu, WardEqualsTheReferenceUpToTheRoundingOfItsHalfVector)
{
    constexpr double step = 2.5e-7;
    std::vector<ShadingCase> cases;
    for (shared::uint model : {shared::WARD_PUBLISHED, shared::WARD_DUER, shared::WARD_BOUNDED})
        for (glm::vec2 slope : {glm::vec2(1e-4f), glm::vec2(1e-3f, 1), glm::vec2(0.1f), glm::vec2(0.4f),
                                glm::vec2(1.5f), glm::vec2(1.5f, 1e-4f)})
            for (double zi : {1.0, 0.9, 0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-20, 0.0, -0.5})
                for (double zo : {1.0, 0.9, 0.3, 1e-2, 1e-4, 1e-6, 1e-20, 0.0, -1.0})
                    for (double phi : {0.0, 0.3, 0.5, 0.999, 1.0, 1.5}) {
                        ShadingCase c{};
                        c.formula = shared::FORMULA_WARD;
                        c.model = model;
                        c.params.slope = slope;
                        c.a = direction(zi, 0);
                        c.b = direction(zo, phi * std::numbers::pi);
                        cases.push_back(c);
                    }
    const std::vector<glm::vec3> values = evaluate(cases);
    double worst = 0;
    for (std::size_t n = 0; n < cases.size(); ++n) {
        const ShadingCase& c = cases[n];
        const cv::Vec3d i = to_double(c.a), o = to_double(c.b);
        const double ax = c.params.slope.x, ay = c.params.slope.y, value = values[n].x;
        ASSERT_TRUE(is_color(values[n])) << value << " in case " << n;
        const auto model = static_cast<optics::WardModel>(c.model);
        const double reference = optics::ward(model, ax, ay, i, o) * std::max(0.0, i[2]);

        const double wide = 1e9; // a lobe so wide that only the factor before its exponential is left
        const double peak =
            optics::ward(model, wide, wide, i, o) * std::max(0.0, i[2]) * wide * wide / (ax * ay);
        const double hz = std::max(i[2], optics::ward_min_cosine) + std::max(o[2], optics::ward_min_cosine);
        const double steepness = std::hypot((i[0] + o[0]) / ax, (i[1] + o[1]) / ay) / hz;
        const double slack = step * std::hypot(1 / ax, 1 / ay) / hz;
        const double low = std::exp(-std::pow(steepness + slack, 2));
        const double high = std::exp(-std::pow(std::max(0.0, steepness - slack), 2));
        const double relative = 1e-5 + 3e-7 * steepness * steepness; // exp() may be off by 3 + 2 |x| steps
        EXPECT_GE(value, peak * low * (1 - relative) - tiny) << "case " << n << ", reference " << reference;
        EXPECT_LE(value, peak * high * (1 + relative) + tiny) << "case " << n << ", reference " << reference;
        if (ax >= 0.1f && ay >= 0.1f && hz > 0.05 && reference > 1e-6)
            worst = std::max(worst, std::abs(value / reference - 1));
    }
    EXPECT_LT(worst, 2e-5); // relative, for slopes of .1 and more
    RecordProperty("ward_worst_relative_error", std::to_string(worst));
}

TEST_F(ShadingOnGpu, TranslucencyEqualsTheReference)
{
    std::vector<ShadingCase> cases;
    for (shared::uint model : {shared::TRANSLUCENCY_PUBLISHED, shared::TRANSLUCENCY_BOUNDED})
        for (float alpha : {0.2f, 0.0f, -0.01f, 100.0f})
            for (float beta : {0.75f, 1e-6f, 40.0f})
                for (float gamma : {0.0f, 0.5f, 10.0f, 100.0f})
                    for (float bound : {0.4285714f, 0.0f, 1e-3f, 100.0f})
                        for (float d : {0.0f, 1e-6f, 0.9f, 2.0f, 3.1f, 100.0f, 1e6f}) {
                            if (alpha * d + beta <= 0)
                                continue; // refused when the scene is loaded
                            ShadingCase c{};
                            c.formula = shared::FORMULA_TRANSLUCENCY;
                            c.model = model;
                            c.params.alpha = alpha;
                            c.params.beta = beta;
                            c.params.gamma = gamma;
                            c.params.translucency_bound_4 =
                                static_cast<float>(std::pow(std::max<double>(bound, 1e-9), -4));
                            c.a.x = bound;
                            c.number = d;
                            cases.push_back(c);
                        }
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n) {
        const ShadingCase& c = cases[n];
        ASSERT_TRUE(is_color(values[n])) << values[n].x << " in case " << n;
        optics::Shading shading;
        shading.alpha = c.params.alpha;
        shading.beta = c.params.beta;
        shading.gamma = c.params.gamma;
        shading.translucency_model = static_cast<optics::TranslucencyModel>(c.model);
        shading.rho_d = 0;
        shading.rho_ts = c.a.x > 0 ? 1.0 / c.a.x : 0; // so that this is the bound
        const double reference =
            std::min(optics::translucency(shading, c.number), std::exp2(31.0)); // the shader's upper limit
        // log2 is accurate to 5e-7 near 1, alpha d + beta to a float step; gamma multiplies both errors.
        const double relative = 5e-6 + 1e-6 * c.params.gamma + 3e-7 * std::abs(std::log2(reference + tiny));
        EXPECT_NEAR(values[n].x, reference, relative * reference + 2e-9) << "case " << n;
        if (c.model == shared::TRANSLUCENCY_BOUNDED) {
            EXPECT_LE(values[n].x, c.a.x * (1 + 1e-6f) + 2e-9f);
        }
    }
}

TEST_F(ShadingOnGpu, BlendEqualsTheReferenceAndIsExactAtItsEnds)
{
    std::vector<ShadingCase> cases;
    for (shared::uint model : {shared::BLEND_PUBLISHED, shared::BLEND_CORRECTED})
        for (float r :
             {-1.0f, -1e-20f, 0.0f, 1e-38f, 1e-12f, 1e-6f, 0.01f, 0.3f, 0.7f, 0.999999f, 1.0f, 2.0f}) {
            ShadingCase c{};
            c.formula = shared::FORMULA_BLEND;
            c.model = model;
            c.number = r;
            c.a = {0.5f, 0.03f, 0};
            c.b = {0.7f, 0.2f, 1};
            c.c = {0.62f, 0.4f, 0.31f};
            cases.push_back(c);
        }
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n) {
        const ShadingCase& c = cases[n];
        const cv::Vec3d reference = optics::blend(static_cast<optics::BlendModel>(c.model), to_double(c.a),
                                                  to_double(c.b), to_double(c.c), c.number);
        EXPECT_LT(max_difference(values[n], reference), 1e-6) << "r = " << c.number;
        EXPECT_TRUE(is_color(values[n]));
        if (c.number <= 0) {
            EXPECT_EQ(values[n], c.a);
        }
        if (c.number >= 1 && c.model == shared::BLEND_CORRECTED) {
            EXPECT_EQ(values[n], c.c);
        }
    }
}

TEST_F(ShadingOnGpu, ColorCurvesEqualTheReference)
{
    std::vector<ShadingCase> cases;
    for (shared::uint formula :
         {shared::FORMULA_SRGB_FROM_LINEAR, shared::FORMULA_LINEAR_FROM_SRGB, shared::FORMULA_SHOULDER})
        for (int n = 0; n <= 1024; ++n) {
            ShadingCase c{};
            c.formula = formula;
            const float x = static_cast<float>(n) / 1024;
            c.a = {x, x * x * x, formula == shared::FORMULA_SHOULDER ? 65504 * x : x * 0.05f};
            cases.push_back(c);
        }
    const auto shoulder = [](double x) {
        return x < 0.8 ? x : 1 - 0.04 / (x - 0.6);
    }; // a hyperbola through (.8, .8)
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n)
        for (int k = 0; k < 3; ++k) {
            const double x = cases[n].a[k];
            const double reference =
                cases[n].formula == shared::FORMULA_SRGB_FROM_LINEAR   ? base::srgb_from_linear(x)
                : cases[n].formula == shared::FORMULA_LINEAR_FROM_SRGB ? base::linear_from_srgb(x)
                                                                       : shoulder(x);
            // The shader's sRGB curve is a fit, off by at most .009 of an 8-bit code.
            const double bound = cases[n].formula == shared::FORMULA_SRGB_FROM_LINEAR ? 4e-5 : 2e-6;
            EXPECT_NEAR(values[n][k], reference, bound) << "formula " << cases[n].formula << " of " << x;
            EXPECT_LE(values[n][k], 1);
        }
}

TEST_F(ShadingOnGpu, FramesAreOrthonormalWhateverTheInterpolatedVectorsAre)
{
    const std::vector<glm::vec3> vectors = {
        {0, 0, 1}, {0, 0, -1},        {1, 0, 0},     {0.3f, -0.5f, 0.2f}, {1e-20f, 0, 0},
        {0, 0, 0}, {1e20f, 1e20f, 0}, {0, 3, 1e-6f}, {-0.6f, 0, -0.8f},   {0, -1e-36f, 0}};
    std::vector<ShadingCase> cases;
    for (const glm::vec3& normal : vectors)
        for (const glm::vec3& tangent : vectors)
            for (float sign : {1.0f, -1.0f})
                for (shared::uint formula :
                     {shared::FORMULA_TANGENT, shared::FORMULA_BITANGENT, shared::FORMULA_NORMAL}) {
                    ShadingCase c{};
                    c.formula = formula;
                    c.a = normal;
                    c.b = tangent;
                    c.number = sign;
                    cases.push_back(c);
                }
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); n += 3) {
        const glm::dvec3 t(values[n]), b(values[n + 1]), normal(values[n + 2]);
        const glm::dmat3 frame(t, b, normal), gram = glm::transpose(frame) * frame;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                EXPECT_NEAR(gram[column][row], row == column, 2e-6) << "case " << n;
        EXPECT_NEAR(glm::determinant(frame), cases[n].number, 1e-5) << "case " << n;
        const glm::dvec3 given(cases[n].a);
        if (glm::length(given) > 1e-30) {
            EXPECT_NEAR(glm::dot(normal, given) / glm::length(given), 1, 1e-6) << "case " << n;
        }
    }
}

TEST_F(ShadingOnGpu, NormalsThatFaceAwayAreTurnedJustIntoView)
{
    std::vector<ShadingCase> cases;
    for (double z : {1.0, 0.5, 0.02, 0.0, -0.3, -0.999, -1.0}) {
        ShadingCase c{};
        c.formula = shared::FORMULA_BEND;
        c.a = direction(z, 1);
        c.b = {0, 0, 1};
        cases.push_back(c);
    }
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n) {
        EXPECT_NEAR(glm::length(values[n]), 1, 1e-6);
        EXPECT_GE(values[n].z, 0.009f) << cases[n].a.z;
        if (cases[n].a.z > 0.01f) {
            EXPECT_EQ(values[n], cases[n].a);
        }
    }
}

TEST_F(ShadingOnGpu, WholeEquationEqualsTheReference)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ShadingCase> cases;
    std::vector<cv::Vec3d> references;
    for (int n = 0; n < 3000; ++n) {
        optics::Shading shading;
        shading.alpha_x = 0.1 + unit(random);
        shading.alpha_y = 0.1 + unit(random);
        shading.ward_model = static_cast<optics::WardModel>(n % 3);
        shading.specular_model = static_cast<optics::SpecularModel>(n % 2);
        shading.translucency_model = static_cast<optics::TranslucencyModel>(n / 3 % 2);
        shading.transport = static_cast<optics::Transport>(n / 18 % optics::transport_names.size());
        optics::Light light;
        light.kind = static_cast<optics::LightKind>(n / 6 % 3);
        light.position = {2 * unit(random) - 1, 2 * unit(random) - 1, unit(random)};
        light.direction = cv::normalize(light.position);
        light.strength = {unit(random), 2 * unit(random), 3 * unit(random)};
        light.reference_distance_m = 0.2 + unit(random);
        light.paper_units_per_m = optics::paper_units_per_m(0.2 + unit(random));

        ShadingCase c{};
        c.formula = shared::FORMULA_SHADE;
        c.model = static_cast<shared::uint>(shading.ward_model);
        c.translucency = static_cast<shared::uint>(shading.translucency_model);
        c.specular = static_cast<shared::uint>(shading.specular_model);
        c.wetness = static_cast<float>(n % 5 == 0 ? 0 : unit(random));
        c.slope_variance = static_cast<float>(n % 7 == 0 ? 0 : .2 * unit(random));
        c.number = static_cast<float>(unit(random));
        c.a = glm::vec3(0.1 * unit(random), 0.1 * unit(random), n % 50 == 0 ? 0.0 : -0.1 * unit(random));
        c.b = direction(unit(random), 6 * unit(random));
        c.c = glm::vec3(unit(random), unit(random), unit(random));
        optics::ShadedPoint point;
        point.scattering_length_mm = 2 * base::Color(unit(random), unit(random), n % 7 == 0 ? 0 : unit(random));
        if (n % 5 != 0)
            point.curvature = {200 * unit(random) - 100, 300 * unit(random) * unit(random)};
        const optics::ShadowMap map{.filter_m = 2e-3 * unit(random) + 1e-4, .through_m = 5e-3 * unit(random)};
        c.params = passes::shading_params(shading, point.scattering_length_mm);
        c.light = passes::lighting(std::span(&light, 1)).light[0];
        c.transport = static_cast<shared::uint>(shading.transport);
        c.curvature = glm::vec2(glm::dvec2(point.curvature[0], point.curvature[1]));
        c.filter_m = float(map.filter_m);
        c.through_m = float(map.through_m);
        c.smooth_normal = direction(n % 2 == 0 ? 1 - 0.3 * unit(random) : 2 * unit(random) - 1, 6 * unit(random));
        cases.push_back(c);
        point.smooth = to_double(c.smooth_normal);

        point.position = to_double(c.a);
        point.to_viewer = to_double(c.b);
        point.albedo = to_double(c.c);
        point.finish = {c.wetness, c.slope_variance};
        references.push_back(optics::shade(shading, light, point, c.number, map));
    }
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n) {
        EXPECT_TRUE(is_color(values[n]));
        EXPECT_LT(max_difference(values[n], references[n]),
                  5e-5 * cv::norm(references[n], cv::NORM_INF) + 1e-7)
            << n;
    }
}

TEST_F(ShadingOnGpu, SurroundingsLeftEqualsTheReference)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto color = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
    std::vector<ShadingCase> cases;
    std::vector<cv::Vec3d> references;
    for (int n = 0; n < 3000; ++n) {
        optics::Shading shading;
        shading.transport = static_cast<optics::Transport>(n % 9 == 0 ? n / 9 % 3 : 2);
        optics::ShadedPoint point;
        point.scattering_length_mm =
            2 * base::Color(unit(random), unit(random), n % 7 == 0 ? 0 : unit(random));
        point.curvature = {200 * unit(random) - 100, 300 * unit(random)};
        ShadingCase c{};
        c.formula = shared::FORMULA_SURROUNDINGS_LEFT;
        c.a = n % 11 == 0 ? glm::vec3(0, 1, 1) : color();
        c.b = color();
        c.transport = static_cast<shared::uint>(shading.transport);
        c.curvature = glm::vec2(glm::dvec2(point.curvature[0], point.curvature[1]));
        c.thinness = n % 5 == 0 ? 0 : static_cast<float>(2000 * unit(random) * unit(random));
        c.params = passes::shading_params(shading, point.scattering_length_mm);
        cases.push_back(c);
        point.albedo = to_double(c.a);
        point.thinness = c.thinness;
        references.push_back(optics::surroundings_left(shading, point, to_double(c.b)));
    }
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n)
        EXPECT_LT(max_difference(values[n], references[n]),
                  5e-5 * cv::norm(references[n], cv::NORM_INF) + 1e-6)
            << n;
}

TEST_F(ShadingOnGpu, DipoleEqualsTheReference)
{
    std::vector<ShadingCase> cases;
    std::vector<cv::Vec3d> references;
    for (const float r2 : {0.f, 1e-4f, .01f, .3f, 1.f, 10.f, 100.f, 1e4f})
        for (const float transport : {.05f, .5f, 2.f}) {
            ShadingCase c{};
            c.formula = shared::FORMULA_DIPOLE;
            c.a = glm::vec3(transport, 2 * transport, 3 * transport);
            c.b = {.1f, .5f, 2};
            c.c = {.4f, 1.5f, 2};
            c.number = r2;
            cases.push_back(c);
            cv::Vec3d& reference = references.emplace_back();
            for (int i = 0; i < 3; ++i)
                reference[i] = optics::DipoleSources{c.a[i], c.b[i], c.c[i]}.at_squared(r2);
        }
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n)
        EXPECT_LT(max_difference(values[n], references[n]), 2e-5 * cv::norm(references[n], cv::NORM_INF) + 1e-12)
            << n;
}
