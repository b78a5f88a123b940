// The highlight and the light from all around: the shaders' formulas against their double twins, at the extremes too.
#include <gtest/gtest.h>
#include <numbers>

#include "shading_cases.hpp"
#include "wound/optics/specular.hpp"
#include "wound/optics/surroundings.hpp"

namespace {

using namespace shading_cases;
using ShadingOnGpu = gpu_test::Test;

} // namespace

// The film's lobe and the wide lobe lose as much as Ward's above; the narrow lobe is a fourth power, which
// has four times the error.
TEST_F(ShadingOnGpu, SkinsHighlightIsFiniteAtTheExtremesAndEqualsTheReferenceAwayFromThem)
{
    std::vector<ShadingCase> cases;
    std::vector<double> references;
    optics::Light light;
    light.kind = optics::LightKind::Directional;
    for (const float slope : {1e-4f, .06f, .3f, 1.5f})
        for (const double zi : {1.0, .9, .5, .1, 1e-3, 1e-6, 1e-20, 0.0, -.5})
            for (const double zo : {1.0, .9, .3, 1e-2, 1e-6, 1e-20, 0.0})
                for (const double phi : {0.0, .5, 1.0})
                    for (const float wetness : {0.f, .3f, 1.f})
                        for (const float variance : {0.f, .3f}) {
                            optics::Shading shading = optics::skin_shading();
                            shading.rho_d = shading.rho_ts = 0;
                            shading.alpha_x = shading.alpha_y = slope;
                            const glm::vec3 to_light = direction(zi, 0),
                                            to_viewer = direction(zo, phi * std::numbers::pi);
                            light.direction = to_double(to_light);
                            ShadingCase c{};
                            c.formula = shared::FORMULA_SHADE;
                            c.model = shared::WARD_BOUNDED;
                            c.specular = shared::SPECULAR_SKIN;
                            c.number = 1;
                            c.b = to_viewer;
                            c.wetness = wetness;
                            c.slope_variance = variance;
                            c.params = passes::shading_params(shading);
                            c.light = passes::lighting(std::span(&light, 1)).light[0];
                            cases.push_back(c);
                            const cv::Vec3d i = to_double(to_light), o = to_double(to_viewer);
                            references.push_back(std::max(0.0, i[2]) *
                                                 optics::specular(shading, {wetness, variance}, i, o));
                        }
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n) {
        ASSERT_TRUE(is_color(values[n])) << values[n].x << " in case " << n;
        if (cases[n].params.slope.x >= .06f && cases[n].light.direction.z + cases[n].b.z > .05f) {
            EXPECT_NEAR(values[n].x, references[n], 3e-4 * references[n] + 1e-7) << n;
        }
    }
}

TEST_F(ShadingOnGpu, LightFromAllAroundEqualsTheReference)
{
    std::vector<ShadingCase> cases;
    std::vector<cv::Vec3d> references;
    const optics::Shading shading = optics::skin_shading();
    for (const float x : {0.f, 1e-6f, .01f, .2f, .5f, .9f, 1.f})
        for (const float y : {0.f, .3f, .8f, 1.f}) {
            ShadingCase c{};
            c.params = passes::shading_params(shading);
            c.number = x;
            c.formula = shared::FORMULA_VISIBILITY;
            c.a = {y, .5f * y, .2f};
            cases.push_back(c);
            references.push_back(optics::visibility(x, to_double(c.a)));
            c.formula = shared::FORMULA_AMBIENT_SPECULAR;
            c.wetness = y;
            cases.push_back(c);
            references.push_back(cv::Vec3d::all(optics::ambient_specular(shading, {y}, x)));
            c.formula = shared::FORMULA_SPECULAR_OCCLUSION;
            c.a.y = 2 * y - 1;
            c.a.x = y;
            cases.push_back(c);
            references.push_back({optics::specular_occlusion(x, y), optics::above_horizon(c.a.y),
                                  optics::bounced_share(x, c.a.y)});
        }
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n) {
        EXPECT_TRUE(is_color(values[n]));
        EXPECT_LT(max_difference(values[n], references[n]), 2e-5) << n;
    }
}

TEST_F(ShadingOnGpu, EveryLightPositionGivesAValidColor)
{
    std::vector<ShadingCase> cases;
    for (shared::uint kind :
         {shared::LIGHT_DIRECTIONAL, shared::LIGHT_POINT, shared::LIGHT_POINT_WITHOUT_FALLOFF})
        for (shared::uint model : {0u, 1u, 2u})
            for (float slope : {1e-4f, 0.4f, 1.5f})
                for (glm::vec3 place : {glm::vec3(0), glm::vec3(0, 0, 1e-20f), glm::vec3(0, 0, 1e-4f),
                                        glm::vec3(1e3f), glm::vec3(0, 0, -1), glm::vec3(1, 0, 1e-9f)})
                    for (float z : {1.0f, 1e-7f, 0.0f, -1.0f}) {
                        ShadingCase c{};
                        c.formula = shared::FORMULA_SHADE;
                        c.model = model;
                        c.translucency = model % 2;
                        c.specular = place.x > 0 ? shared::SPECULAR_WARD : shared::SPECULAR_SKIN;
                        c.wetness = z > 0 ? .5f : 0;
                        c.number = 1;
                        c.transport = model;
                        c.filter_m = 1;
                        c.smooth_normal = direction(z, 1);
                        c.b = direction(z, 3);
                        c.c = glm::vec3(1);
                        c.params = passes::shading_params(optics::Shading{});
                        c.params.slope = glm::vec2(slope, 1e-4f);
                        c.light = passes::lighting(std::vector<optics::Light>(1)).light[0];
                        c.light.kind = kind;
                        c.light.position = place;
                        c.light.strength = glm::vec3(1e4f);
                        c.light.reference_distance = 1e3f;
                        cases.push_back(c);
                    }
    const std::vector<glm::vec3> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n)
        EXPECT_TRUE(is_color(values[n])) << values[n].x << " in case " << n;
}
