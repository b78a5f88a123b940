// Evaluates one formula of shaders/lib per invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shading_case.h"
#include "lib/blend.glsl"
#include "lib/color.glsl"
#include "lib/dipole.glsl"
#include "lib/frame.glsl"
#include "lib/shading.glsl"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer CaseBlock { ShadingCase cases[]; };
layout(binding = 1, rgba32f) uniform writeonly image2D results;

vec3 shade(ShadingCase c)
{
    LightSample light = sample_light(c.light, c.a);
    DiffuseSkin skin = diffuse_skin(c.transport, c.params.rho_d * c.c, c.params.scattering, c.curvature);
    vec3 diffuse = leaving(c.transport, skin, light.strength, light.direction, c.b, dot(c.smooth_normal, light.direction),
                           Shade(c.number, c.filter_m, c.through_m));
    if (c.transport == TRANSPORT_PUBLISHED)
        diffuse += c.c * subsurface_diffuse(c.translucency, c.params, c.light, c.a);
    return diffuse + c.number * light.strength *
                         specular_times_cosine(c.specular, c.model, true, c.params, Finish(c.wetness, c.slope_variance),
                                               light.direction, c.b);
}

vec3 left_of_surroundings(ShadingCase c)
{
    return surroundings_left(c.transport, diffuse_skin(c.transport, c.params.rho_d * c.a, c.params.scattering, c.curvature), c.b,
                             c.thinness);
}

vec3 evaluate(ShadingCase c)
{
    switch (c.formula)
    {
    case FORMULA_WARD: return vec3(ward_times_cosine(ward_form(c.model, c.a, c.b), c.params.slope));
    case FORMULA_TRANSLUCENCY: return vec3(translucency_weight(c.model, c.params, c.number));
    case FORMULA_BLEND: return recovering_color(c.model, c.a, c.b, c.c, c.number);
    case FORMULA_SRGB_FROM_LINEAR: return srgb_from_linear(c.a);
    case FORMULA_LINEAR_FROM_SRGB: return linear_from_srgb(c.a);
    case FORMULA_SHOULDER: return soft_shoulder(c.a);
    case FORMULA_TANGENT: return frame_of(c.a, vec4(c.b, c.number))[0];
    case FORMULA_BITANGENT: return frame_of(c.a, vec4(c.b, c.number))[1];
    case FORMULA_NORMAL: return frame_of(c.a, vec4(c.b, c.number))[2];
    case FORMULA_BEND: return bend_to_viewer(c.a, c.b);
    case FORMULA_SHADE: return shade(c);
    case FORMULA_SURROUNDINGS_LEFT: return left_of_surroundings(c);
    case FORMULA_DIPOLE: return dipole_share(Dipole(c.a, c.b, c.c, vec3(1.0)), c.number);
    case FORMULA_VISIBILITY: return visibility(c.number, c.a);
    case FORMULA_SPECULAR_OCCLUSION: return vec3(specular_occlusion(c.number, c.a.x), above_horizon(c.a.y), bounced_share(c.number, c.a.y));
    case FORMULA_AMBIENT_SPECULAR: return vec3(ambient_specular(c.params, Finish(c.wetness, 0.0), c.number));
    }
    return vec3(-1.0);
}

void main()
{
    uint index = gl_GlobalInvocationID.y * imageSize(results).x + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x < imageSize(results).x && index < cases.length())
        imageStore(results, ivec2(gl_GlobalInvocationID.xy), vec4(evaluate(cases[index]), 1.0));
}
