#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// E. Golubev 2018, "Efficient screen-space subsurface scattering using Burley's normalized diffusion in real-time" (SIGGRAPH
// course "Advances in real-time rendering"): each pixel sums up samples on a disc whose radii take equal shares of the
// widest channel's light, by the profile of their distance in space (the bilateral weight), over the sum of weights.
#include "lib/screen_diffusion.glsl"
#include "shared/skin.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 5, rgba16f) uniform writeonly image2D spread;
layout(scalar, binding = 6) uniform Diffusion_ { Diffusion diffusion; };

// Of a pixel of the picture, the same in every tile: 0..1. Each pixel turns its samples by another angle, as the
// author does: what few samples miss is noise and no pattern.
float hashed(ivec2 pixel)
{
    uint x = uint(pixel.x) * 1664525u + uint(pixel.y) * 22695477u + 1013904223u;
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return float((x ^ (x >> 16)) >> 8) / 16777216.0;
}

void main()
{
    const ivec2 p = ivec2(gl_GlobalInvocationID.xy), size = imageSize(spread);
    if (any(greaterThanEqual(p, size)))
        return;
    const vec4 behind = texelFetch(specular, p, 0);
    const SkinPixel here = skin_pixel(p);
    if (here.share < LEAST_SKIN)
    {
        imageStore(spread, p, behind);
        return;
    }
    const float reach = length(diffusion.taps[DIFFUSION_TAPS - 1].xy);
    const float pixels = pixels_per_width(here, reach);
    const float widest = max(max(here.width.r, here.width.g), here.width.b);
    const float area = 3.14159265 * reach * reach * pixels * pixels;
    const int samples = clamp(int(area / PIXELS_PER_SAMPLE), 1, DIFFUSION_TAPS);
    const float angle = 6.28318531 * hashed(p + tile.corner);
    const mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    vec3 sum = vec3(0), total = vec3(0);
    for (int i = 0; i < samples; ++i)
    {
        const vec3 tap = diffusion.taps[(2 * i + 1) * DIFFUSION_TAPS / (2 * samples)].xyz;
        const ivec2 at = clamp(p + ivec2(round(pixels * (turn * tap.xy))), ivec2(tile.low), ivec2(tile.high) - 1);
        const vec4 there = texelFetch(received, at, 0);
        const float share = 1.0 - there.a;
        if (share < LEAST_SKIN)
            continue;
        const float gap = texelFetch(distances, at, 0).r / share - here.distance_m;
        const float radius = widest * length(tap.xy), apart = sqrt(radius * radius + gap * gap);
        const vec3 t = exp(-apart / (3.0 * here.width));
        const vec3 weight = t * (t * t + 1.0) * (tap.z * widest / apart);
        sum += weight * there.rgb / share;
        total += weight;
    }
    const vec3 light = mix(here.light, sum / max(total, vec3(1e-20)), greaterThan(total, vec3(1e-20)));
    imageStore(spread, p, vec4(behind.rgb + here.share * here.albedo * light, behind.a));
}
