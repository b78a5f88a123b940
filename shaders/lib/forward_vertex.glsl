// The head's vertices. Computes the quantities that vary smoothly over the surface: the translucent light of
// eq. (6) and the position in the first two lights' shadow maps.
#ifndef LIB_FORWARD_VERTEX_GLSL
#define LIB_FORWARD_VERTEX_GLSL
#include "lib/shading.glsl"
#include "lib/shadow.glsl"
#include "shared/frame.h"

layout(constant_id = 2) const uint TRANSPORT = TRANSPORT_PREINTEGRATED;
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
layout(location = 5) in vec2 curvature; // 1/m, mean and root mean square
layout(location = 6) in float thinness; // 1/m

layout(location = 0) out vec3 v_position;
layout(location = 1) out vec3 v_normal;
layout(location = 2) out vec4 v_tangent;
layout(location = 3) out vec2 v_uv;
layout(location = 4) out vec3 v_subsurface;
layout(location = 5) out vec4 v_shadow_place[2]; // of the first two lights
layout(location = 7) out vec4 v_shadow_slope[2];
layout(location = 9) out vec2 v_curvature;
layout(location = 10) out float v_occlusion;
layout(location = 11) out float v_thinness;
#ifdef DIFFUSED
layout(location = 7) in vec2 place;
layout(location = 12) out vec2 v_place;
#endif

void main()
{
    v_position = position;
    v_normal = normal;
    v_tangent = tangent;
    v_uv = uv;
    v_occlusion = occlusion;
    v_subsurface = vec3(0);
    if (TRANSPORT == TRANSPORT_PUBLISHED)
        for (uint i = 0; i < LIGHTS; ++i)
            v_subsurface += subsurface_diffuse(TRANSLUCENCY_MODEL, shading, lighting.light[i], position);
    v_curvature = curvature;
    v_thinness = thinness;
#ifdef DIFFUSED
    v_place = place;
#endif
    for (uint i = 0; i < 2; ++i)
    {
        ShadowLookup lookup = ShadowLookup(vec4(0), vec4(0));
        if ((SHADOWS >> i & 1) != 0)
            lookup = shadow_lookup(shadows[i], position, normal, sample_light(lighting.light[i], position).direction,
                                   TRANSPORT, curvature.y);
        v_shadow_place[i] = lookup.place;
        v_shadow_slope[i] = lookup.slope;
    }
    gl_Position = view.clip_from_world * vec4(position, 1);
}

#endif
