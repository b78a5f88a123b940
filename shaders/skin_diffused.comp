#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The light that reaches a texel of the skin's atlas from its surroundings: the mean of what they receive, weighted by
// Burley's profile of the distance in space (d'Eon, Luebke & Enderton 2007; Christensen & Burley 2015). The points lie on
// a spiral whose radii take equal shares of the light, so those nearer than the texel can be left out.
#include "lib/diffusion.glsl"
#include "shared/skin.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D places;  // mm; a: 0: no skin
layout(binding = 1) uniform sampler2D metrics; // mm: L of the metric L L^T (l11, l21, l22), radius of a disc of a texel's area
layout(binding = 2) uniform sampler2D gathered;
layout(binding = 3) uniform sampler2D skin_albedo;
layout(binding = 4, rgba16f) uniform writeonly image2D diffused;
layout(scalar, binding = 5) uniform Diffusion_ { Diffusion diffusion; };

const float NO_SURROUNDINGS = 1e3; // mm

void main()
{
    const ivec2 p = ivec2(gl_GlobalInvocationID.xy), size = imageSize(diffused);
    if (any(greaterThanEqual(p, size)))
        return;
    const vec4 here = texelFetch(places, p, 0);
    if (here.w == 0)
    {
        imageStore(diffused, p, vec4(0, 0, 0, NO_SURROUNDINGS));
        return;
    }
    const vec3 root = textureLod(skin_albedo, (vec2(p) + 0.5) / vec2(size), 0).rgb;
    const vec3 width = max(root * root * diffusion.scattering_mm, vec3(1e3 * LEAST_WIDTH_M));
    const float widest = max(max(width.r, width.g), width.b);
    const vec4 metric = texelFetch(metrics, p, 0);
    const int first = int(left_within(vec3(widest), metric.w).r * float(DIFFUSION_TAPS));
    const vec3 rate = 1 / (-3 * log(2.0) * width); // e^(-r/3d) = 2^(rate r)
    const vec2 along = vec2(widest / metric.x, -metric.y * widest / (metric.x * metric.z));
    const float down = widest / metric.z;
    vec3 sum = vec3(0), total = vec3(0);
    for (int k = DIFFUSION_TAPS - 1; k >= first; --k)
    {
        const vec3 tap = diffusion.taps[k].xyz;
        const vec2 offset = vec2(dot(along, tap.xy), down * tap.y);
        const ivec2 at = p + ivec2(round(offset)), inside = clamp(at, ivec2(0), size - 1);
        const vec4 there = texelFetch(places, inside, 0);
        const bool counts = there.w != 0 && at == inside && max(abs(offset.x), abs(offset.y)) <= DIFFUSION_REACH;
        const float radius = max(distance(there.xyz, here.xyz), metric.w);
        const vec3 t = exp2(rate * radius);
        const vec3 weight = t * (t * t + 1) * (counts ? tap.z / radius : 0);
        sum += weight * texelFetch(gathered, inside, 0).rgb;
        total += weight;
    }
    const vec3 own = texelFetch(gathered, p, 0).rgb;
    imageStore(diffused, p, vec4(mix(own, sum / max(total, vec3(1e-20)), greaterThan(total, vec3(1e-20))), metric.w));
}
