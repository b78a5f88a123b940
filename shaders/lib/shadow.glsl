// Shadow of a light by percentage-closer filtering (Reeves, Salesin & Cook 1987). The shader filters
// itself, because Vulkan does not guarantee linear filtering of depth images.
#ifndef LIB_SHADOW_GLSL
#define LIB_SHADOW_GLSL
#include "shared/shadow.h"

// The lookup position of a surface point in the clip space of the depth image. It is linear in the position, so
// the vertex shader can compute it. to_light: unit.
//
// Moves the point towards the light, which changes the compared depth only. A move along the normal would change
// the place of the lookup too: light would leak past the edges of shadows. By one texel's width, and more where
// light grazes a surface that bends within the filter's footprint.
vec4 shadow_place(Shadow shadow, vec3 position, vec3 normal, vec3 to_light)
{
    float texel = shadow.texel * (shadow.clip_from_world * vec4(position, 1.0)).w;
    float cosine = clamp(dot(normal, to_light), 0.1, 1.0);
    float texels = 1.0 + 0.1 * (1.0 / (cosine * cosine) - 1.0); // 1 + tan^2 / 10
    return shadow.clip_from_world * vec4(position + texels * texel * to_light, 1.0);
}

// Change of the compared depth per texel along x and y, on the plane through the position with the normal: the
// filter compares each texel with the receiver's depth there, so that a tilted surface does not shadow
// itself (Isidoro 2006, "Shadow mapping: GPU-based tips and techniques"). Limited to a tilt of 85 degrees:
// where light grazes more than that it is weak. normal, to_light: unit.
vec2 shadow_slope(Shadow shadow, vec3 position, vec3 normal, vec3 to_light)
{
    vec4 plane = shadow.clip_plane_from_world * vec4(normal, -dot(normal, position));
    vec4 here = shadow.clip_from_world * vec4(position, 1.0);
    vec4 nearer = shadow.clip_from_world * vec4(position + shadow.texel * here.w * to_light, 1.0);
    float steepest = 12.0 * abs(here.z / here.w - nearer.z / nearer.w);
    vec2 slope = -plane.xy * shadow.step;
    float facing = max(abs(plane.z), 1e-20);
    return clamp(slope / (plane.z < 0.0 ? -facing : facing), -steepest, steepest);
}

// Share of the light that reaches the point, 0..1: a 3 x 3 box of bilinear comparisons, i.e. 4 x 4 texels
// weighted (1-f, 1, 1, f) along each axis, fetched by four gathers. `depth` needs a nearest, clamping
// sampler. Points outside the image are lit; inside it lie only points of the head, each in its light's tile. slope: shadow_slope().
float shadow_visibility(sampler2D depth, vec4 place, vec2 slope)
{
    vec3 seen = place.xyz / place.w;
    if (!(place.w > 0.0 && all(lessThanEqual(abs(seen.xy), vec2(1.0))) && seen.z <= 1.0)) // true for NaN too
        return 1.0;

    vec2 size = vec2(textureSize(depth, 0));
    vec2 texel = (seen.xy * 0.5 + 0.5) * size - 0.5;
    vec2 corner = floor(texel), f = texel - corner;
    vec2 first = corner / size; // the common corner of texels -1 and 0
    // The receiver's depth at the first 2 x 2 texels' centres, in a gather's order: (0,1) (1,1) (1,0) (0,0).
    float origin = seen.z - dot(slope, f + 1.0);
    vec4 z = origin + slope.x * vec4(0.0, 1.0, 1.0, 0.0) + slope.y * vec4(1.0, 1.0, 0.0, 0.0);
    vec2 next = 2.0 * slope;
    vec4 lit00 = step(z, textureGather(depth, first));
    vec4 lit10 = step(z + next.x, textureGather(depth, first + vec2(2.0, 0.0) / size));
    vec4 lit01 = step(z + next.y, textureGather(depth, first + vec2(0.0, 2.0) / size));
    vec4 lit11 = step(z + next.x + next.y, textureGather(depth, first + vec2(2.0, 2.0) / size));
    // The weights are (1-f, 1 | 1, f).
    vec2 g = 1.0 - f;
    float sum = dot(lit00, vec4(g.x, 1.0, g.y, g.x * g.y)) + dot(lit10, vec4(1.0, f.x, f.x * g.y, g.y)) +
                dot(lit01, vec4(g.x * f.y, f.y, 1.0, g.x)) + dot(lit11, vec4(f.y, f.x * f.y, f.x, 1.0));
    return sum / 9.0;
}

#endif
