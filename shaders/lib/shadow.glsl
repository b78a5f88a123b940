// Shadow of the key light by percentage-closer filtering (Reeves, Salesin & Cook 1987). The shader filters
// itself, because Vulkan does not guarantee linear filtering of depth images.
#ifndef LIB_SHADOW_GLSL
#define LIB_SHADOW_GLSL
#include "shared/shadow.h"

// The lookup position of a surface point in the light's clip space. The vertex shader computes it with the
// vertex's normal, because it is linear in the position (saves 2 matrix products per pixel). normal,
// to_light: unit.
//
// Offsets the point so that the filter's footprint lies above the tangent plane and a surface does not shadow
// itself: along the normal by the sine of the light's angle, and one texel towards the light.
vec4 shadow_place(Shadow shadow, vec3 position, vec3 normal, vec3 to_light)
{
    float texel = shadow.texel * (shadow.clip_from_world * vec4(position, 1.0)).w;
    float cosine = clamp(dot(normal, to_light), 0.0, 1.0);
    vec3 lifted = position + texel * (2.5 * sqrt(1.0 - cosine * cosine) * normal + to_light);
    return shadow.clip_from_world * vec4(lifted, 1.0);
}

// Share of the light that reaches the point, 0..1: a 3 x 3 box of bilinear comparisons, i.e. 4 x 4 texels
// weighted (1-f, 1, 1, f) along each axis, fetched by four gathers. `depth` needs a nearest, clamping
// sampler. Points outside the shadow map are lit.
float shadow_visibility(sampler2D depth, vec4 place)
{
    vec3 seen = place.xyz / place.w;
    if (!(place.w > 0.0 && all(lessThanEqual(abs(seen.xy), vec2(1.0))) && seen.z <= 1.0)) // true for NaN too
        return 1.0;

    vec2 size = vec2(textureSize(depth, 0));
    vec2 texel = (seen.xy * 0.5 + 0.5) * size - 0.5;
    vec2 corner = floor(texel), f = texel - corner;
    vec2 first = corner / size; // the common corner of texels -1 and 0
    vec4 lit00 = step(seen.z, textureGather(depth, first));
    vec4 lit10 = step(seen.z, textureGather(depth, first + vec2(2.0, 0.0) / size));
    vec4 lit01 = step(seen.z, textureGather(depth, first + vec2(0.0, 2.0) / size));
    vec4 lit11 = step(seen.z, textureGather(depth, first + vec2(2.0, 2.0) / size));
    // A gather returns texels (0,1) (1,1) (1,0) (0,0) of its 2 x 2; the weights are (1-f, 1 | 1, f).
    vec2 g = 1.0 - f;
    float sum = dot(lit00, vec4(g.x, 1.0, g.y, g.x * g.y)) + dot(lit10, vec4(1.0, f.x, f.x * g.y, g.y)) +
                dot(lit01, vec4(g.x * f.y, f.y, 1.0, g.x)) + dot(lit11, vec4(f.y, f.x * f.y, f.x, 1.0));
    return sum / 9.0;
}

#endif
