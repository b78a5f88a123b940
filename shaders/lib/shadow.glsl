// Shadow of the key light by percentage-closer filtering (Reeves, Salesin & Cook 1987), compared by hand because depth
// images need not support linear filtering.
#ifndef LIB_SHADOW_GLSL
#define LIB_SHADOW_GLSL
#include "shared/shadow.h"

// Where a point of the surface is looked up, in the light's clip space. It is linear in the position, so the vertex shader
// computes it (2 matrices less per pixel) with the vertex's normal. normal, to_light: unit.
//
// The point is lifted by as much as the filter's footprint hangs below its tangent plane, so that a surface never shadows
// itself: along the normal in proportion to the light's slant, and a texel towards the light.
vec4 shadow_place(Shadow shadow, vec3 position, vec3 normal, vec3 to_light)
{
    float texel = shadow.texel * (shadow.clip_from_world * vec4(position, 1.0)).w;
    float cosine = clamp(dot(normal, to_light), 0.0, 1.0);
    vec3 lifted = position + texel * (2.5 * sqrt(1.0 - cosine * cosine) * normal + to_light);
    return shadow.clip_from_world * vec4(lifted, 1.0);
}

// Share of the light that reaches the point, 0..1: a 3 x 3 box of bilinear comparisons, which is 4 x 4 texels weighted
// (1-f, 1, 1, f) along either axis, fetched as four gathers. `depth` has a nearest, clamping sampler.
// Points outside the light's picture are lit.
float shadow_visibility(sampler2D depth, vec4 place)
{
    vec3 seen = place.xyz / place.w;
    if (!(place.w > 0.0 && all(lessThanEqual(abs(seen.xy), vec2(1.0))) && seen.z <= 1.0)) // true for NaN too
        return 1.0;

    vec2 size = vec2(textureSize(depth, 0));
    vec2 texel = (seen.xy * 0.5 + 0.5) * size - 0.5;
    vec2 corner = floor(texel), f = texel - corner;
    vec2 first = corner / size; // the corner that texels -1 and 0 share
    vec4 lit00 = step(seen.z, textureGather(depth, first));
    vec4 lit10 = step(seen.z, textureGather(depth, first + vec2(2.0, 0.0) / size));
    vec4 lit01 = step(seen.z, textureGather(depth, first + vec2(0.0, 2.0) / size));
    vec4 lit11 = step(seen.z, textureGather(depth, first + vec2(2.0, 2.0) / size));
    // A gather gives (0,1) (1,1) (1,0) (0,0) of its 2 x 2 texels; the weights are (1-f, 1 | 1, f).
    vec2 g = 1.0 - f;
    float sum = dot(lit00, vec4(g.x, 1.0, g.y, g.x * g.y)) + dot(lit10, vec4(1.0, f.x, f.x * g.y, g.y)) +
                dot(lit01, vec4(g.x * f.y, f.y, 1.0, g.x)) + dot(lit11, vec4(f.y, f.x * f.y, f.x, 1.0));
    return sum / 9.0;
}

#endif
