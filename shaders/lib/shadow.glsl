// Shadow of a light by percentage-closer filtering (Reeves, Salesin & Cook 1987). The shader filters
// itself, because Vulkan does not guarantee linear filtering of depth images.
#ifndef LIB_SHADOW_GLSL
#define LIB_SHADOW_GLSL
#include "shared/shading.h"
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

// A body does not cast a shadow on itself behind its terminator: light that spreads under the skin gets there by another
// way. A point that turns away from the light is replaced by the one where the light's ray through it enters the body,
// which is taken for a ball of the point's curvature (1/m). normal, to_light: unit.
void enter_body(inout vec3 position, inout vec3 normal, vec3 to_light, float curvature)
{
    float behind = 2.0 * max(-dot(normal, to_light), 0.0);
    position += min(behind / max(curvature, 1.0), DEEPEST_BODY) * to_light;
    normal += behind * to_light;
}

// How much deeper than `place` a position is, in the depth image's units, and metres per such unit towards the light.
vec2 shadow_deeper(Shadow shadow, vec4 place, vec3 position, vec3 to_light)
{
    const float step = 0.01;
    vec4 here = shadow.clip_from_world * vec4(position, 1.0);
    vec4 nearer = shadow.clip_from_world * vec4(position + step * to_light, 1.0);
    float depth = here.z / here.w;
    return vec2(depth - place.z / place.w, step / max(depth - nearer.z / nearer.w, 1e-9));
}

// Where a point is looked up, shadow_place(), and x, y: shadow_slope(), z, w: shadow_deeper(), or 0 and 1 for a transport
// that asks for no thickness. Transport preintegrated lets light enter the body.
struct ShadowLookup
{
    vec4 place, slope;
};
ShadowLookup shadow_lookup(Shadow shadow, vec3 position, vec3 normal, vec3 to_light, uint transport, float curvature)
{
    vec3 at = position;
    if (transport == TRANSPORT_PREINTEGRATED)
        enter_body(at, normal, to_light, curvature);
    vec4 place = shadow_place(shadow, at, normal, to_light);
    bool passes = transport == TRANSPORT_PREINTEGRATED || transport == TRANSPORT_DIFFUSED ||
                  transport == TRANSPORT_SEPARABLE || transport == TRANSPORT_BURLEY;
    vec2 depth = passes
                     ? shadow_deeper(shadow, place, position, to_light) : vec2(0.0, 1.0);
    return ShadowLookup(place, vec4(shadow_slope(shadow, at, normal, to_light), depth));
}

// What lies between a light and the point.
struct Shade
{
    float visibility; // share of the light that reaches the point, by the filter of the shadow map, 0..1
    float filter_m;   // half the width of that filter
    float through_m;  // skin between the point and where the light enters it
};
const Shade NO_SHADE = Shade(1.0, 1.0, 1e3);

vec4 before(float z, vec4 first)
{
    return max(z - first, 0.0);
}

// A 3 x 3 box of bilinear comparisons, i.e. 4 x 4 texels weighted (1-f, 1, 1, f) along each axis, fetched by four
// gathers. `depth` needs a nearest, clamping sampler. Points outside the image are lit; inside it lie only points of the
// head, each in its light's tile.
Shade shadow_sample(sampler2D depth, Shadow shadow, ShadowLookup lookup)
{
    const vec4 place = lookup.place;
    const vec2 slope = lookup.slope.xy;
    const float deeper = lookup.slope.z;
    vec3 seen = place.xyz / place.w;
    if (!(place.w > 0.0 && all(lessThanEqual(abs(seen.xy), vec2(1.0))) && seen.z <= 1.0)) // true for NaN too
        return NO_SHADE;

    vec2 size = vec2(textureSize(depth, 0));
    vec2 texel = (seen.xy * 0.5 + 0.5) * size - 0.5;
    vec2 corner = floor(texel), f = texel - corner;
    vec2 first = corner / size; // the common corner of texels -1 and 0
    // The receiver's depth at the first 2 x 2 texels' centres, in a gather's order: (0,1) (1,1) (1,0) (0,0).
    float origin = seen.z - dot(slope, f + 1.0);
    vec4 z = origin + slope.x * vec4(0.0, 1.0, 1.0, 0.0) + slope.y * vec4(1.0, 1.0, 0.0, 0.0);
    vec2 next = 2.0 * slope;
    vec4 z00 = z, z10 = z + next.x, z01 = z + next.y, z11 = z + next.x + next.y;
    vec4 first00 = textureGather(depth, first), first10 = textureGather(depth, first + vec2(2.0, 0.0) / size);
    vec4 first01 = textureGather(depth, first + vec2(0.0, 2.0) / size),
         first11 = textureGather(depth, first + vec2(2.0, 2.0) / size);
    // The weights are (1-f, 1 | 1, f).
    vec2 g = 1.0 - f;
    vec4 w00 = vec4(g.x, 1.0, g.y, g.x * g.y), w10 = vec4(1.0, f.x, f.x * g.y, g.y);
    vec4 w01 = vec4(g.x * f.y, f.y, 1.0, g.x), w11 = vec4(f.y, f.x * f.y, f.x, 1.0);
    float lit = dot(step(z00, first00), w00) + dot(step(z10, first10), w10) + dot(step(z01, first01), w01) +
                dot(step(z11, first11), w11);
    // Without the slope: at a body's outline, where the receiver's plane is steep, that would make it thin.
    float own = seen.z + deeper;
    float behind = dot(before(own, first00), w00) + dot(before(own, first10), w10) + dot(before(own, first01), w01) +
                   dot(before(own, first11), w11);
    return Shade(lit / 9.0, 1.75 * shadow.texel * place.w, behind / 9.0 * lookup.slope.w);
}

#endif
