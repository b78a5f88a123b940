#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Computes slope and occlusion of the wound from its depth, and the slope of the bed's bumps from its colour, once per
// day, so that the forward pass samples only one map.
#include "shared/wound.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D state;
layout(binding = 1, rgba16f) uniform writeonly image2D relief;
layout(scalar, binding = 2) uniform Relief_ { Relief params; };
layout(binding = 3) uniform sampler2D color;

float depth(ivec2 p)
{
    const vec4 s = texelFetch(state, clamp(p, ivec2(0), textureSize(state, 0) - 1), 0);
    return params.depth_scale * s.r - params.scar_mm * max(s.a - s.b, 0);
}

// ln of the mean luminance of the four texels around a corner.
float log_luminance(vec2 corner)
{
    const vec3 mean = textureLod(color, corner / vec2(textureSize(color, 0)), 0).rgb;
    return log(max(dot(mean, vec3(0.2126, 0.7152, 0.0722)), 1e-3));
}

// The bed is as high as it is light: pits of granulation tissue are dark. As the slope of a depth.
vec2 bump_slope(ivec2 p)
{
    const vec2 middle = vec2(p) + 0.5;
    const float d = params.bump_texels;
    const float lt = log_luminance(middle + vec2(-d, -d)), rt = log_luminance(middle + vec2(d, -d)),
                lb = log_luminance(middle + vec2(-d, d)), rb = log_luminance(middle + vec2(d, d));
    return params.bump_mm / (4 * d * params.texel_mm) * vec2(lt + lb - rt - rb, lt + rt - lb - rb);
}

void main()
{
    const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(relief);
    if (any(greaterThanEqual(p, size)))
        return;

    // Sobel filter: less noisy than the central difference of the same width.
    const float l = depth(p + ivec2(-1, -1)) + 2 * depth(p + ivec2(-1, 0)) + depth(p + ivec2(-1, 1));
    const float r = depth(p + ivec2(1, -1)) + 2 * depth(p + ivec2(1, 0)) + depth(p + ivec2(1, 1));
    const float t = depth(p + ivec2(-1, -1)) + 2 * depth(p + ivec2(0, -1)) + depth(p + ivec2(1, -1));
    const float b = depth(p + ivec2(-1, 1)) + 2 * depth(p + ivec2(0, 1)) + depth(p + ivec2(1, 1));
    vec2 slope = vec2(r - l, b - t) / (8 * params.texel_mm);
    const float bed = texelFetch(state, p, 0).b;
    if (bed > 0 && params.bump_mm > 0)
        slope += bed * bump_slope(p);
    slope /= 1 + params.slope_limit * length(slope);

    // Horizon-based occlusion from the wound's walls in six directions. cos^2 of the horizon's elevation is
    // the cosine-weighted share of the sky that is visible in a direction's slice.
    const float here = depth(p);
    float open = 0;
    for (int k = 0; k < 6; ++k)
    {
        const float angle = 6.2831853 * (float(k) + 0.5) / 6;
        const vec2 direction = vec2(cos(angle), sin(angle));
        float steepest = 0; // tangent of the horizon's elevation
        for (int step = 1; step <= 4; ++step)
        {
            const float distance_texels = params.reach_texels * float(step * step) / 16;
            const float rise = here - depth(p + ivec2(round(direction * distance_texels)));
            steepest = max(steepest, rise / (max(distance_texels, 1.0) * params.texel_mm));
        }
        open += 1 / (1 + steepest * steepest);
    }
    imageStore(relief, p, vec4(slope, open / 6, here));
}
