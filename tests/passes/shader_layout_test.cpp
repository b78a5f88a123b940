// Each struct of shaders/shared/ has the same layout in C++ and in the shipped shaders.
#include <gtest/gtest.h>

#include "shaders/shared/frame.h"
#include "shaders/shared/labels.h"
#include "shaders/shared/part.h"
#include "shaders/shared/reflectance_lut.h"
#include "shaders/shared/shading.h"
#include "shaders/shared/shadow.h"
#include "shaders/shared/wound.h"
#include "tests/support/layout.hpp"

using namespace shared;

TEST(ShaderLayout, Frame)
{
    gpu_test::expect_layout("forward.frag", "View", sizeof(View),
                            {CICATRIX_MEMBER(View, clip_from_world), CICATRIX_MEMBER(View, eye)});
    gpu_test::expect_layout("forward.frag", "WoundFrame", sizeof(WoundFrame),
                            {CICATRIX_MEMBER(WoundFrame, centre), CICATRIX_MEMBER(WoundFrame, half_width),
                             CICATRIX_MEMBER(WoundFrame, right), CICATRIX_MEMBER(WoundFrame, reach),
                             CICATRIX_MEMBER(WoundFrame, down), CICATRIX_MEMBER(WoundFrame, day),
                             CICATRIX_MEMBER(WoundFrame, normal), CICATRIX_MEMBER(WoundFrame, uv_scale),
                             CICATRIX_MEMBER(WoundFrame, uv_offset),
                             CICATRIX_MEMBER(WoundFrame, bed_recovery),
                             CICATRIX_MEMBER(WoundFrame, border_recovery), CICATRIX_MEMBER(WoundFrame, lut),
                             CICATRIX_MEMBER(WoundFrame, epithelium), CICATRIX_MEMBER(WoundFrame, pore_loss),
                             CICATRIX_MEMBER(WoundFrame, sheen), CICATRIX_MEMBER(WoundFrame, number)});
}

TEST(ShaderLayout, Part)
{
    gpu_test::expect_layout("forward.frag", "Part", sizeof(Part),
                            {CICATRIX_MEMBER(Part, albedo_factor), CICATRIX_MEMBER(Part, normal_scale),
                             CICATRIX_MEMBER(Part, specular), CICATRIX_MEMBER(Part, slope),
                             CICATRIX_MEMBER(Part, grazing), CICATRIX_MEMBER(Part, translucency),
                             CICATRIX_MEMBER(Part, scattering)});
}

TEST(ShaderLayout, ReflectanceLut)
{
    gpu_test::expect_layout("reflectance_lut.comp", "LutLayer", sizeof(LutLayer),
                            {CICATRIX_MEMBER(LutLayer, g), CICATRIX_MEMBER(LutLayer, n),
                             CICATRIX_MEMBER(LutLayer, thickness_mm)});
    gpu_test::expect_layout("reflectance_lut.comp", "LutBand", sizeof(LutBand),
                            {CICATRIX_MEMBER(LutBand, sigma_a), CICATRIX_MEMBER(LutBand, sigma_s_reduced)});
    gpu_test::expect_layout("reflectance_lut.comp", "LutDay", sizeof(LutDay),
                            {CICATRIX_MEMBER(LutDay, missing_ratio), CICATRIX_MEMBER(LutDay, regrown_ratio)});
    gpu_test::expect_layout("reflectance_lut.comp", "LutAxes", sizeof(LutAxes),
                            {CICATRIX_MEMBER(LutAxes, deepest_mm), CICATRIX_MEMBER(LutAxes, last_day)});
    gpu_test::expect_layout("reflectance_lut.comp", "LutParameters", sizeof(LutParameters),
                            {CICATRIX_MEMBER(LutParameters, axes), CICATRIX_MEMBER(LutParameters, n_above),
                             CICATRIX_MEMBER(LutParameters, n_below),
                             CICATRIX_MEMBER(LutParameters, layers_per_day),
                             CICATRIX_MEMBER(LutParameters, bands)});
}

TEST(ShaderLayout, Labels)
{
    gpu_test::expect_layout("labels.frag", "LabelCamera", sizeof(LabelCamera),
                            {CICATRIX_MEMBER(LabelCamera, eye), CICATRIX_MEMBER(LabelCamera, forward),
                             CICATRIX_MEMBER(LabelCamera, pixel_area)});
}

TEST(ShaderLayout, Shading)
{
    for (const char* stage : {"forward.frag", "forward.vert", "shading_test.comp"}) {
        gpu_test::expect_layout(
            stage, "ShadingParams", sizeof(ShadingParams),
            {CICATRIX_MEMBER(ShadingParams, rho_d), CICATRIX_MEMBER(ShadingParams, rho_ts),
             CICATRIX_MEMBER(ShadingParams, rho_s), CICATRIX_MEMBER(ShadingParams, alpha),
             CICATRIX_MEMBER(ShadingParams, beta), CICATRIX_MEMBER(ShadingParams, gamma),
             CICATRIX_MEMBER(ShadingParams, translucency_bound_4), CICATRIX_MEMBER(ShadingParams, slope),
             CICATRIX_MEMBER(ShadingParams, ambient), CICATRIX_MEMBER(ShadingParams, fresnel_scale),
             CICATRIX_MEMBER(ShadingParams, grazing), CICATRIX_MEMBER(ShadingParams, mirrored),
             CICATRIX_MEMBER(ShadingParams, scattering)});
        gpu_test::expect_layout(stage, "Light", sizeof(Light),
                                {CICATRIX_MEMBER(Light, position), CICATRIX_MEMBER(Light, kind),
                                 CICATRIX_MEMBER(Light, direction),
                                 CICATRIX_MEMBER(Light, reference_distance), CICATRIX_MEMBER(Light, strength),
                                 CICATRIX_MEMBER(Light, distance_scale)});
    }
    for (const char* stage : {"forward.frag", "forward.vert"})
        gpu_test::expect_layout(stage, "Lighting", sizeof(Lighting),
                                {CICATRIX_MEMBER(Lighting, count), CICATRIX_MEMBER(Lighting, light)});
}

TEST(ShaderLayout, Shadow)
{
    for (const char* stage : {"forward.vert", "shadow.vert"})
        gpu_test::expect_layout(stage, "Shadow", sizeof(Shadow),
                                {CICATRIX_MEMBER(Shadow, clip_from_world),
                                 CICATRIX_MEMBER(Shadow, clip_plane_from_world),
                                 CICATRIX_MEMBER(Shadow, texel), CICATRIX_MEMBER(Shadow, step)});
}

TEST(ShaderLayout, Wound)
{
    gpu_test::expect_layout("wound_texture.comp", "WarpHeader", sizeof(WarpHeader),
                            {CICATRIX_MEMBER(WarpHeader, center), CICATRIX_MEMBER(WarpHeader, scale),
                             CICATRIX_MEMBER(WarpHeader, grid_epsilon), CICATRIX_MEMBER(WarpHeader, model),
                             CICATRIX_MEMBER(WarpHeader, first), CICATRIX_MEMBER(WarpHeader, count),
                             CICATRIX_MEMBER(WarpHeader, steps)});
    gpu_test::expect_layout("wound_texture.comp", "BedPhase", sizeof(BedPhase),
                            {CICATRIX_MEMBER(BedPhase, clot), CICATRIX_MEMBER(BedPhase, fibrin),
                             CICATRIX_MEMBER(BedPhase, granulation), CICATRIX_MEMBER(BedPhase, rim),
                             CICATRIX_MEMBER(BedPhase, bed_luminance)});
    gpu_test::expect_layout("wound_texture.comp", "WoundToday", sizeof(WoundToday),
                            {CICATRIX_MEMBER(WoundToday, border), CICATRIX_MEMBER(WoundToday, bed),
                             CICATRIX_MEMBER(WoundToday, first_texel),
                             CICATRIX_MEMBER(WoundToday, border_softness),
                             CICATRIX_MEMBER(WoundToday, bed_presence), CICATRIX_MEMBER(WoundToday, phase)});
    gpu_test::expect_layout("wound_relief.comp", "Relief", sizeof(Relief),
                            {CICATRIX_MEMBER(Relief, depth_scale), CICATRIX_MEMBER(Relief, scar_mm),
                             CICATRIX_MEMBER(Relief, texel_mm), CICATRIX_MEMBER(Relief, reach_texels),
                             CICATRIX_MEMBER(Relief, bump_mm), CICATRIX_MEMBER(Relief, bump_texels),
                             CICATRIX_MEMBER(Relief, slope_limit)});
}
