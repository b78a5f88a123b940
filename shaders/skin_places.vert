#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What of the head lies where on the skin's atlas, and beyond the borders of its charts.
#include "lib/on_atlas.glsl"

layout(scalar, binding = 0) uniform Surface_ { SurfaceDraw draw; };

layout(location = 0) in vec2 place;           // units
layout(location = 1) in vec2 outward;         // of a skirt, per unit of its width
layout(location = 2) in vec3 position;        // m
layout(location = 3) in vec3 position_outward; // m, per unit

layout(location = 0) out vec3 v_position; // mm

void main()
{
    v_position = 1e3 * (position + draw.skirt * position_outward);
    gl_Position = on_atlas(draw, place, outward);
}
