#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The skin, spread out on its atlas.
#include "lib/on_atlas.glsl"

layout(scalar, binding = 0) uniform Draw_ { AtlasDraw draw; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in float occlusion;
layout(location = 5) in vec2 place;
layout(location = 6) in vec2 outward;

layout(location = 0) out vec3 v_position;
layout(location = 1) out vec3 v_normal;
layout(location = 2) out vec4 v_tangent;
layout(location = 3) out vec2 v_uv;
layout(location = 10) out float v_occlusion;

void main()
{
    v_position = position;
    v_normal = normal;
    v_tangent = tangent;
    v_uv = uv;
    v_occlusion = occlusion;
    gl_Position = on_atlas(draw, place, outward);
}
