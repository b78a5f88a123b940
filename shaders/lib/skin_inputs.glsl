// A point of the head, from the interpolated vertex and the maps of its part, with the wounds that reach it. What
// forward.frag and skin_map.frag have in common: their constants, inputs and bindings too.
#ifndef LIB_SKIN_INPUTS_GLSL
#define LIB_SKIN_INPUTS_GLSL
#include "lib/frame.glsl"
#include "lib/wound_projection.glsl"
#include "shared/part.h"

layout(constant_id = 0) const uint WOUNDS = 0; // number of projected wounds, at most WOUNDS_HERE
layout(constant_id = 4) const bool NORMAL_MAP = true;
layout(constant_id = 6) const bool AMBIENT = true; // ambient light times occlusion
layout(constant_id = 9) const uint BLEND_MODEL = BLEND_CORRECTED;
layout(constant_id = 12) const bool OCCLUSION_MAP = true; // false: the vertices' occlusion

layout(location = 0) in vec3 v_position;
layout(location = 1) in vec3 v_normal;
layout(location = 2) in vec4 v_tangent;
layout(location = 3) in vec2 v_uv;
layout(location = 10) in float v_occlusion;

layout(scalar, binding = 1) uniform Part_ { Part part; };
layout(scalar, binding = 4) uniform Wounds_ { WoundFrame wounds[WOUNDS_HERE]; };
layout(binding = 5) uniform sampler2D albedo_map;
layout(binding = 6) uniform sampler2D normal_map;
layout(binding = 7) uniform sampler2D occlusion_map;
layout(binding = 8) uniform sampler2D wound_color[WOUNDS_HERE];
layout(binding = 9) uniform sampler2D wound_state[WOUNDS_HERE];
layout(binding = 10) uniform sampler2D wound_relief[WOUNDS_HERE];
layout(binding = 11) uniform sampler2D reflectance_lut[WOUNDS_HERE];

// frame: of the smooth surface. open: share of the surroundings that the head lets through; SkinPoint::occlusion: that the
// wound does.
SkinPoint skin_here(mat3 frame, out float alpha, out float open)
{
    const vec4 albedo = texture(albedo_map, v_uv) * part.albedo_factor;
    alpha = albedo.a;
    SkinPoint skin = SkinPoint(albedo.rgb, frame[2], 1, 0, 0, 0);
    if (NORMAL_MAP)
    {
        const vec3 mapped = texture(normal_map, v_uv).xyz * 2 - 1;
        skin.normal = normalize_or(frame * vec3(mapped.xy * part.normal_scale, max(mapped.z, 0.05)), frame[2]);
    }
    open = 1;
    if (AMBIENT)
        open = OCCLUSION_MAP ? texture(occlusion_map, v_uv).r : v_occlusion;
    // Unrolled: indexing an array of samplers by a loop counter is ten times slower on a software rasteriser.
    [[unroll]] for (uint i = 0; i < WOUNDS_HERE; ++i)
        if (i < WOUNDS)
            add_wound(BLEND_MODEL, wounds[i], wound_color[i], wound_state[i], wound_relief[i], reflectance_lut[i], v_position,
                      frame[2], skin);
    return skin;
}

#endif
