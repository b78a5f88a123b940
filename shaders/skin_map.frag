#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// What the skin is like, without light: reflectance, normal, gloss, with today's wounds.
#include "lib/on_atlas.glsl"
#include "lib/skin_code.glsl"
#include "lib/skin_inputs.glsl"

layout(scalar, binding = 0) uniform Draw_ { AtlasDraw draw; };

layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec4 out_normal; // of the head, not of the picture
layout(location = 2) out vec4 out_gloss;

void main()
{
    float alpha, open;
    const SkinPoint skin = skin_here(frame_of(v_normal, v_tangent), alpha, open);
    if (outside_tile(draw, gl_FragCoord.xy))
        discard;
    out_albedo = coded_albedo(skin.albedo, open);
    out_normal = vec4(skin.normal * 0.5 + 0.5, 1);
    out_gloss = coded_gloss(skin);
}
