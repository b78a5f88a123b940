#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Chang et al. 2008: each pixel sums up all samples of the skin, E A R_d / (N p), and light from nearer than the samples lie
// to each other, their "local effect", is gathered around the pixel: in the picture, after Mertens et al. 2003 ("Efficient
// rendering of local subsurface scattering"), whom they name for it.
#include "lib/dipole.glsl"
#include "lib/screen_diffusion.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 5, rgba16f) uniform writeonly image2D spread;
layout(scalar, binding = 6) uniform Chang_ { ChangView chang; };
layout(binding = 7) uniform sampler2D sample_places; // mm
layout(binding = 8) uniform sampler2D sample_lights; // mm^2 x light

vec3 light_nearby(ivec2 p, SkinPixel here)
{
    const float pixels = min(1e-3 * chang.local_mm * tile.pixels_at_1m / max(here.distance_m, 1e-3), float(PICTURE_REACH - 1));
    vec3 sum = vec3(0), total = vec3(0);
    for (int i = 0; i < 64; ++i)
    {
        const vec3 tap = chang.taps[i].xyz;
        const ivec2 at = clamp(p + ivec2(round(pixels * tap.xy)), ivec2(tile.low), ivec2(tile.high) - 1);
        const vec4 there = texelFetch(received, at, 0);
        const float share = 1.0 - there.a;
        if (share < LEAST_SKIN)
            continue;
        const float gap = 1e3 * (texelFetch(distances, at, 0).r / share - here.distance_m);
        const float r2 = chang.local_mm * chang.local_mm * dot(tap.xy, tap.xy) + gap * gap;
        const vec3 weight = tap.z * dipole_share(chang.dipole, r2);
        sum += weight * there.rgb / share;
        total += weight;
    }
    return mix(here.light, sum / max(total, vec3(1e-20)), greaterThan(total, vec3(1e-20)));
}

void main()
{
    const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(spread))))
        return;
    const vec4 behind = texelFetch(specular, p, 0);
    const SkinPixel here = skin_pixel(p);
    if (here.share < LEAST_SKIN)
    {
        imageStore(spread, p, behind);
        return;
    }
    const vec2 slope = (vec2(p) + 0.5 - chang.centre) / tile.pixels_at_1m;
    const vec3 position = chang.eye + 1e3 * here.distance_m * (chang.forward + slope.x * chang.right + slope.y * chang.down);
    vec3 light = chang.local_share * light_nearby(p, here);
    for (int i = 0; i < CHANG_SAMPLES; ++i)
    {
        const vec3 offset = texelFetch(sample_places, ivec2(i, 0), 0).xyz - position;
        const float r2 = dot(offset, offset);
        if (r2 > chang.local_mm * chang.local_mm)
            light += dipole_share(chang.dipole, r2) * texelFetch(sample_lights, ivec2(i, 0), 0).rgb;
    }
    imageStore(spread, p, vec4(behind.rgb + here.share * here.albedo * light, behind.a));
}
