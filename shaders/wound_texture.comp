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

// Depth and coverage of one mip level, smoothed by a cubic B-spline, whose slope has no kinks at the texels' centres: four
// bilinear reads (Sigg and Hadwiger 2005, "Fast third-order texture filtering").
vec2 smooth_shape(vec2 uv, int level)
{
    const vec2 size = vec2(textureSize(day0_shape, level));
    const vec2 at = uv * size - 0.5, f = fract(at), g = 1 - f;
    const vec2 left = (g * g * g + 4 + 3 * f * f * (f - 2)) / 6, right = 1 - left;
    const vec2 a = (floor(at) + 0.5 - g * g * g / (6 * left)) / size, b = (floor(at) + 1.5 + f * f * f / (6 * right)) / size;
    const vec2 above = left.x * textureLod(day0_shape, a, level).rg + right.x * textureLod(day0_shape, vec2(b.x, a.y), level).rg;
    const vec2 below = left.x * textureLod(day0_shape, vec2(a.x, b.y), level).rg + right.x * textureLod(day0_shape, b, level).rg;
    return left.y * above + right.y * below;
}

vec2 smooth_shape(vec2 uv, float level)
{
    level = clamp(level, 0.0, float(textureQueryLevels(day0_shape) - 1));
    return mix(smooth_shape(uv, int(level)), smooth_shape(uv, int(ceil(level))), fract(level));
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
    // New skin has a soft edge: its shape comes from a mip level that blurs by about a millimetre.
    if (PHASES)
    {
        border_shape = mix(border_shape, smooth_shape(from_border * 0.5 + 0.5, border_mip + 3), today.border_softness);
        // Clot and slough come in patches with soft edges, so a blurred level says what turns into them.
        const vec3 around = textureLod(day0_color, from_border * 0.5 + 0.5, border_mip + 2.5).rgb;
        day0.rgb = mix(day0.rgb, tinted(day0.rgb, around, today.phase), bed_shape.g);
        day0.a *= mix(today.phase.rim, 1, border_shape.g);
    }
    bed_shape.g *= today.bed_presence;
    imageStore(color, texel, day0);
    imageStore(state, texel, vec4(bed_shape.r, border_shape.r, bed_shape.g, border_shape.g));
}
