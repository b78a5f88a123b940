#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The head's vertices. Computes the quantities that vary smoothly over the surface: the translucent light of
// eq. (6) and the position in the first two lights' shadow maps.
#include "lib/shading.glsl"
#include "lib/shadow.glsl"
#include "shared/frame.h"

layout(constant_id = 2) const bool TRANSLUCENCY = true;
layout(constant_id = 5) const uint SHADOWS = 0; // bit i: light i casts a shadow
layout(constant_id = 8) const uint TRANSLUCENCY_MODEL = TRANSLUCENCY_BOUNDED;
layout(constant_id = 10) const uint LIGHTS = 1;

layout(scalar, binding = 0) uniform View_ { View view; };
layout(scalar, binding = 2) uniform Shading_ { ShadingParams shading; };
layout(scalar, binding = 3) uniform Lighting_ { Lighting lighting; };
layout(scalar, binding = 13) uniform Shadows_ { Shadow shadows[MAX_LIGHTS]; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in float occlusion;

layout(location = 0) out vec3 v_position;
layout(location = 1) out vec3 v_normal;
layout(location = 2) out vec4 v_tangent;
layout(location = 3) out vec2 v_uv;
layout(location = 4) out vec3 v_subsurface;
layout(location = 5) out vec4 v_shadow_place[2]; // of the first two lights
layout(location = 7) out vec2 v_shadow_slope[2];
layout(location = 9) out float v_occlusion;

void main()
{
    v_position = position;
    v_normal = normal;
    v_tangent = tangent;
    v_uv = uv;
    v_occlusion = occlusion;
    v_subsurface = vec3(0);
    if (TRANSLUCENCY)
        for (uint i = 0; i < LIGHTS; ++i)
            v_subsurface += subsurface_diffuse(TRANSLUCENCY_MODEL, shading, lighting.light[i], position);
    for (uint i = 0; i < 2; ++i)
    {
        v_shadow_place[i] = vec4(0);
        v_shadow_slope[i] = vec2(0);
        if ((SHADOWS >> i & 1) != 0)
        {
            const vec3 to_light = sample_light(lighting.light[i], position).direction;
            v_shadow_place[i] = shadow_place(shadows[i], position, normal, to_light);
            v_shadow_slope[i] = shadow_slope(shadows[i], position, normal, to_light);
        }
    }
    gl_Position = view.clip_from_world * vec4(position, 1);
}
