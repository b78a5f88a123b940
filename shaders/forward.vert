#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The head's vertices. Computes the quantities that vary smoothly over the surface: the translucent light of
// eq. (6) and the position in the first light's shadow map.
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

layout(location = 0) out vec3 v_position;
layout(location = 1) out vec3 v_normal;
layout(location = 2) out vec4 v_tangent;
layout(location = 3) out vec2 v_uv;
layout(location = 4) out vec3 v_subsurface;
layout(location = 5) out vec4 v_shadow_place;
layout(location = 6) out vec2 v_shadow_slope;

void main()
{
    v_position = position;
    v_normal = normal;
    v_tangent = tangent;
    v_uv = uv;
    v_subsurface = vec3(0);
    if (TRANSLUCENCY)
        for (uint i = 0; i < LIGHTS; ++i)
            v_subsurface += subsurface_diffuse(TRANSLUCENCY_MODEL, shading, lighting.light[i], position);
    v_shadow_place = vec4(0);
    v_shadow_slope = vec2(0);
    if ((SHADOWS & 1) != 0)
    {
        const vec3 to_light = sample_light(lighting.light[0], position).direction;
        v_shadow_place = shadow_place(shadows[0], position, normal, to_light);
        v_shadow_slope = shadow_slope(shadows[0], position, normal, to_light);
    }
    gl_Position = view.clip_from_world * vec4(position, 1);
}
