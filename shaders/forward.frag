#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Shades the head: albedo and normal map, wounds projected in object space and blended by eq. (4), shading by
// eq. (8) of Choi & Chin 2014. A term that a specialisation constant turns off is not compiled.
#include "lib/frame.glsl"
#include "lib/color.glsl"
#include "lib/shading.glsl"
#include "lib/shadow.glsl"
#include "lib/wound_projection.glsl"
#include "shared/part.h"

layout(constant_id = 0) const uint WOUNDS = 0; // number of projected wounds
layout(constant_id = 1) const bool LAMBERT = true;
layout(constant_id = 2) const uint TRANSPORT = TRANSPORT_PREINTEGRATED;
layout(constant_id = 3) const bool WARD = true;
layout(constant_id = 4) const bool NORMAL_MAP = true;
layout(constant_id = 5) const uint SHADOWS = 0; // bit i: light i casts a shadow
layout(constant_id = 6) const bool AMBIENT = true; // ambient light times occlusion
layout(constant_id = 7) const uint WARD_MODEL = WARD_BOUNDED;
layout(constant_id = 8) const uint TRANSLUCENCY_MODEL = TRANSLUCENCY_BOUNDED;
layout(constant_id = 9) const uint BLEND_MODEL = BLEND_CORRECTED;
layout(constant_id = 10) const uint LIGHTS = 1;
layout(constant_id = 11) const uint SPECULAR_MODEL = SPECULAR_SKIN;
layout(constant_id = 12) const bool OCCLUSION_MAP = true; // false: the vertices' occlusion

layout(location = 0) in vec3 v_position;
layout(location = 1) in vec3 v_normal;
layout(location = 2) in vec4 v_tangent;
layout(location = 3) in vec2 v_uv;
layout(location = 4) in vec3 v_subsurface;
layout(location = 5) in vec4 v_shadow_place[2]; // of the first two lights
layout(location = 7) in vec4 v_shadow_slope[2];
layout(location = 9) in vec2 v_curvature; // 1/m
layout(location = 10) in float v_occlusion;
layout(location = 0) out vec4 out_color;

layout(scalar, binding = 0) uniform View_ { View view; };
layout(scalar, binding = 1) uniform Part_ { Part part; };
layout(scalar, binding = 2) uniform Shading_ { ShadingParams shading; };
layout(scalar, binding = 3) uniform Lighting_ { Lighting lighting; };
layout(scalar, binding = 4) uniform Wounds_ { WoundFrame wounds[MAX_WOUNDS]; };
layout(binding = 5) uniform sampler2D albedo_map;
layout(binding = 6) uniform sampler2D normal_map;
layout(binding = 7) uniform sampler2D occlusion_map;
layout(binding = 8) uniform sampler2D wound_color[MAX_WOUNDS];
layout(binding = 9) uniform sampler2D wound_state[MAX_WOUNDS];
layout(binding = 10) uniform sampler2D wound_relief[MAX_WOUNDS];
layout(binding = 11) uniform sampler2D reflectance_lut[MAX_WOUNDS];
layout(binding = 12) uniform sampler2D shadow_map;
layout(scalar, binding = 13) uniform Shadows_ { Shadow shadows[MAX_LIGHTS]; };

#define ADD_WOUND(i)                                                                                                            \
    if (WOUNDS > i)                                                                                                            \
        add_wound(BLEND_MODEL, wounds[i], wound_color[i], wound_state[i], wound_relief[i], reflectance_lut[i], v_position,     \
                  geometric, skin);

void main()
{
    const vec3 to_viewer = normalize_or(view.eye - v_position, vec3(0, 0, 1));
    mat3 frame = frame_of(gl_FrontFacing ? v_normal : -v_normal, v_tangent);
    const vec3 geometric = frame[2];
    const vec4 albedo = texture(albedo_map, v_uv) * part.albedo_factor;

    SkinPoint skin = SkinPoint(albedo.rgb, geometric, 1, 0, 0, 0);
    if (NORMAL_MAP)
    {
        const vec3 mapped = texture(normal_map, v_uv).xyz * 2 - 1;
        skin.normal = normalize_or(frame * vec3(mapped.xy * part.normal_scale, max(mapped.z, 0.05)), geometric);
    }
    float open = 1; // share of the surroundings that the head lets through; skin.occlusion: that the wound does
    if (AMBIENT)
        open = OCCLUSION_MAP ? texture(occlusion_map, v_uv).r : v_occlusion;
    // Unrolled by hand: indexing an array of samplers by a loop counter is ten times slower on a software
    // rasteriser.
    ADD_WOUND(0) ADD_WOUND(1) ADD_WOUND(2) ADD_WOUND(3) ADD_WOUND(4) ADD_WOUND(5) ADD_WOUND(6)

    frame = frame_of(bend_to_viewer(skin.normal, to_viewer), v_tangent);
    // Eq. (7) as published: neither wetness nor occlusion touches it.
    const bool only_ward = SPECULAR_MODEL == SPECULAR_WARD && WARD_MODEL == WARD_PUBLISHED;
    const ShadingParams params = with_gloss(SPECULAR_MODEL, only_ward, shading, part, skin);
    const Finish finish = Finish(skin.wetness, skin.slope_variance);
    const vec3 local_viewer = to_viewer * frame;
    const vec3 visible = AMBIENT ? visibility(open * skin.occlusion, params.rho_d * skin.albedo) : vec3(0);
    const DiffuseSkin body =
        diffuse_skin(TRANSPORT, params.rho_d * skin.albedo, part.scattering * params.scattering, v_curvature);
    vec3 diffuse = params.ambient * visible * skin.albedo * body.gain; // ambient: times rho_d already
    vec3 mirrored = vec3(0), bounced = vec3(0);
    for (uint i = 0; i < LIGHTS; ++i)
    {
        LightSample light = sample_light(lighting.light[i], v_position);
        const vec3 local_light = light.direction * frame;
        if (AMBIENT && LAMBERT)
            bounced += light.strength * bounced_share(open, local_light.z);
        Shade shade = NO_SHADE;
        if ((SHADOWS >> i & 1) != 0)
        {
            // The place is interpolated for two lights: to compute it per pixel doubles the cost of the pass.
            ShadowLookup lookup = ShadowLookup(v_shadow_place[min(i, 1)], v_shadow_slope[min(i, 1)]);
            if (LIGHTS > 2 && i > 1)
                lookup = shadow_lookup(shadows[i], v_position, geometric, light.direction,
                                       TRANSPORT == TRANSPORT_PREINTEGRATED, v_curvature.y);
            shade = shadow_sample(shadow_map, shadows[i], lookup);
        }
        if (LAMBERT)
            diffuse += leaving(TRANSPORT, body, light.strength, local_light, local_viewer, dot(geometric, light.direction), shade);
        light.strength *= shade.visibility;
        if (WARD)
            mirrored += light.strength * specular_times_cosine(SPECULAR_MODEL, WARD_MODEL, WOUNDS > 0, params, finish, local_light,
                                                               local_viewer);
    }
    diffuse += body.albedo * body.albedo * bounced;
    // Translucency is multiplied by ambient occlusion, except in the published model.
    if (TRANSPORT == TRANSPORT_PUBLISHED)
        diffuse += v_subsurface * skin.albedo *
                   (part.translucency * (TRANSLUCENCY_MODEL == TRANSLUCENCY_PUBLISHED ? 1 : open * skin.occlusion));
    // The head's own shadows dim the lights' highlights, but a wound's hollow is in no shadow map.
    mirrored *= only_ward ? 1 : skin.occlusion;
    if (AMBIENT && WARD && SPECULAR_MODEL == SPECULAR_SKIN)
        mirrored += params.mirrored * skin.occlusion * ambient_highlight(params, finish, open, frame[2], geometric, to_viewer);
    const vec3 radiance = diffuse + mirrored;
    out_color = vec4(finite_radiance(radiance), albedo.a);
}
