// The lights and their shadows at a point: what forward.frag and light_map.frag have in common.
#ifndef LIB_LIGHT_INPUTS_GLSL
#define LIB_LIGHT_INPUTS_GLSL
#include "lib/shading.glsl"
#include "lib/shadow.glsl"

layout(constant_id = 1) const bool LAMBERT = true;
layout(constant_id = 2) const uint TRANSPORT = TRANSPORT_PREINTEGRATED;
layout(constant_id = 5) const uint SHADOWS = 0; // bit i: light i casts a shadow
layout(constant_id = 10) const uint LIGHTS = 1;
layout(constant_id = 14) const bool BOUNCE = true; // light that reaches a hollow by way of the skin around it

layout(location = 5) in vec4 v_shadow_place[2]; // of the first two lights
layout(location = 7) in vec4 v_shadow_slope[2];
layout(location = 9) in vec2 v_curvature; // 1/m, as the next
layout(location = 11) in float v_thinness;

layout(scalar, binding = 2) uniform Shading_ { ShadingParams shading; };
layout(scalar, binding = 3) uniform Lighting_ { Lighting lighting; };
layout(binding = 12) uniform sampler2D shadow_map;
layout(scalar, binding = 13) uniform Shadows_ { Shadow shadows[MAX_LIGHTS]; };

// visibility(), or without the light that goes back and forth.
vec3 surroundings_seen(float open, vec3 albedo) { return BOUNCE ? visibility(open, albedo) : vec3(open); }

// geometric: unit normal of the smooth surface.
Shade shade_here(uint i, vec3 position, vec3 geometric, vec3 to_light)
{
    if ((SHADOWS >> i & 1) == 0)
        return NO_SHADE;
    // The place is interpolated for two lights: to compute it per pixel doubles the cost of the pass.
    ShadowLookup lookup = ShadowLookup(v_shadow_place[min(i, 1)], v_shadow_slope[min(i, 1)]);
    if (LIGHTS > 2 && i > 1)
        lookup =
            shadow_lookup(shadows[i], position, geometric, to_light, TRANSPORT, v_curvature.y);
    return shadow_sample(shadow_map, shadows[i], lookup);
}

#endif
