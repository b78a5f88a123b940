#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/on_atlas.glsl"

layout(scalar, binding = 0) uniform Draw_ { AtlasDraw draw; };

layout(location = 0) in vec3 v_position;
layout(location = 0) out vec4 out_home; // mm; a: mm^2, area of the texel, 0: no skin

void main()
{
    const float area = length(cross(dFdx(v_position), dFdy(v_position)));
    if (outside_tile(draw, gl_FragCoord.xy))
        discard;
    out_home = vec4(v_position, area);
}
