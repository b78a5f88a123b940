#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/on_atlas.glsl"

layout(scalar, binding = 0) uniform Surface_ { SurfaceDraw draw; };

layout(location = 0) in vec3 v_position;
layout(location = 0) out vec4 out_place;  // mm; a: 1, there is skin
layout(location = 1) out vec4 out_metric; // mm, see skin_diffused.comp

void main()
{
    const vec3 x = dFdx(v_position), y = dFdy(v_position);
    if (outside_tile(draw, gl_FragCoord.xy))
        discard;
    const float along = max(length(x), 1e-6), skew = dot(x, y) / along;
    const float across = sqrt(max(dot(y, y) - skew * skew, 1e-12));
    out_place = vec4(v_position, 1);
    out_metric = vec4(along, skew, across, sqrt(along * across / 3.14159265));
}
