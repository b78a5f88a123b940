#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The light on the skin, for skin_diffused.comp: at its texels, and beyond the borders of charts the light that falls on
// the skin across the seam.
#include "lib/on_atlas.glsl"

layout(scalar, binding = 0) uniform Surface_ { SurfaceDraw draw; };

layout(location = 0) in vec2 place;        // units
layout(location = 1) in vec2 outward;      // of a skirt, per unit of its width
layout(location = 2) in vec2 from;         // units, where the light is taken from
layout(location = 3) in vec2 from_outward; // per unit

layout(location = 0) out vec2 v_from; // share of the atlas' size

void main()
{
    v_from = (from + draw.skirt * from_outward) / draw.size;
    gl_Position = on_atlas(draw, place, outward);
}
