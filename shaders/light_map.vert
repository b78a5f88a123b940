#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The skin, spread out on its atlas, and its places in the first two lights' shadow maps.
#include "lib/on_atlas.glsl"
#include "lib/shading.glsl"
#include "lib/shadow.glsl"

layout(constant_id = 2) const uint TRANSPORT = TRANSPORT_PREINTEGRATED;
layout(constant_id = 5) const uint SHADOWS = 0; // bit i: light i casts a shadow

layout(scalar, binding = 0) uniform Draw_ { AtlasDraw draw; };
layout(scalar, binding = 3) uniform Lighting_ { Lighting lighting; };
layout(scalar, binding = 13) uniform Shadows_ { Shadow shadows[MAX_LIGHTS]; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 curvature; // 1/m, mean and root mean square
layout(location = 3) in vec2 place;
layout(location = 4) in vec2 outward;
layout(location = 5) in float thinness; // 1/m

layout(location = 0) out vec3 v_position;
layout(location = 1) out vec3 v_normal;
layout(location = 5) out vec4 v_shadow_place[2];
layout(location = 7) out vec4 v_shadow_slope[2];
layout(location = 9) out vec2 v_curvature;
layout(location = 11) out float v_thinness;

void main()
{
    v_position = position;
    v_normal = normal;
    v_curvature = curvature;
    v_thinness = thinness;
    for (uint i = 0; i < 2; ++i)
    {
        ShadowLookup lookup = ShadowLookup(vec4(0), vec4(0));
        if ((SHADOWS >> i & 1) != 0)
            lookup = shadow_lookup(shadows[i], position, normal, sample_light(lighting.light[i], position).direction,
                                   TRANSPORT, curvature.y);
        v_shadow_place[i] = lookup.place;
        v_shadow_slope[i] = lookup.slope;
    }
    gl_Position = on_atlas(draw, place, outward);
}
