#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/on_atlas.glsl"

layout(scalar, binding = 0) uniform Surface_ { SurfaceDraw draw; };
layout(binding = 1) uniform sampler2D irradiance;

layout(location = 0) in vec2 v_from;
layout(location = 0) out vec4 out_light;

void main()
{
    if (outside_tile(draw, gl_FragCoord.xy))
        discard;
    out_light = vec4(textureLod(irradiance, v_from, 0).rgb, 1);
}
