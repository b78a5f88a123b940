#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The skin on its atlas, each triangle where it is at home: once, for integrals over the skin.
#include "lib/on_atlas.glsl"

layout(scalar, binding = 0) uniform Draw_ { AtlasDraw draw; };

layout(location = 0) in vec3 position; // m
layout(location = 1) in vec2 place;    // share of the atlas' size

layout(location = 0) out vec3 v_position; // mm

void main()
{
    v_position = 1e3 * position;
    gl_Position = on_atlas(draw, place, vec2(0));
}
