#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Warps the wound's day-0 maps to today, Choi & Chin 2014, section 3. For each texel the backward warp gives
// the position of its skin on day 0.
#include "lib/phases.glsl"
#include "shared/wound.h"

layout(constant_id = 0) const uint WARP_MODEL = 1;          // wound::WarpModel
layout(constant_id = 1) const bool BED_APART = false; // the bed closes inside the border by a separate warp
layout(constant_id = 2) const bool PHASES = false;    // the bed passes through clot, fibrin and granulation

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D day0_color; // rgb reflectance, a opacity
layout(binding = 1) uniform sampler2D day0_shape; // r depth in mm, g coverage of the mask
layout(binding = 2, rgba16f) uniform writeonly image2D color;
layout(binding = 3, rgba16f) uniform writeonly image2D state;
layout(scalar, binding = 4) uniform Today_ { WoundToday today; };
layout(scalar, binding = 5) readonly buffer WarpValues_ { vec2 warp_values[]; };
#include "lib/warp.glsl"

// Contraction maps several day-0 texels to one of today's; the ratio of the radii gives the mip level to
// sample.
float mip_of(vec2 today_point, vec2 day0_point, vec2 centre)
{
    return log2(max(distance(day0_point, centre) / max(distance(today_point, centre), 1e-6), 1));
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(color);
    if (any(greaterThanEqual(texel, size)))
        return;
    const vec2 p = (vec2(texel + today.first_texel) + 0.5) * 2 / vec2(textureSize(day0_color, 0)) - 1;

    const vec2 from_border = warp_backward(WARP_MODEL, today.border, p);
    const float border_mip = mip_of(p, from_border, today.border.center);
    vec4 day0 = textureLod(day0_color, from_border * 0.5 + 0.5, border_mip);
    vec2 border_shape = textureLod(day0_shape, from_border * 0.5 + 0.5, border_mip).rg;
    vec2 bed_shape = border_shape;
    if (BED_APART)
    {
        const vec2 from_bed = warp_backward(WARP_MODEL, today.bed, p);
        bed_shape = textureLod(day0_shape, from_bed * 0.5 + 0.5, mip_of(p, from_bed, today.bed.center)).rg;
    }
    // New skin has a soft edge: its coverage comes from a mip level that blurs by about a millimetre.
    if (PHASES)
        border_shape.g = mix(border_shape.g, textureLod(day0_shape, from_border * 0.5 + 0.5, border_mip + 3.5).g,
                             today.border_softness);
    if (PHASES)
    {
        day0.rgb = mix(day0.rgb, tinted(day0.rgb, today.phase), bed_shape.g);
        day0.a *= mix(today.phase.rim, 1, border_shape.g);
    }
    bed_shape.g *= today.bed_presence;
    imageStore(color, texel, day0);
    imageStore(state, texel, vec4(bed_shape.r, border_shape.r, bed_shape.g, border_shape.g));
}
