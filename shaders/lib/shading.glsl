// Choi & Chin 2014, eq. (8), light by light: Lambert (5), translucency (6), Ward (7). Linear Rec. 709.
#ifndef LIB_SHADING_GLSL
#define LIB_SHADING_GLSL
#include "lib/translucency.glsl"
#include "lib/ward.glsl"
#include "shared/shading.h"

struct LightSample
{
    vec3 direction; // unit, towards the light
    vec3 strength;  // I at the point: radiance of a white diffuser that faces the light there
    vec3 source;    // I at the reference distance, for eq. (6), whose own distance is its falloff
    float distance; // d of eq. (6), paper's unit
};

LightSample sample_light(Light light, vec3 position)
{
    const float nearest = 1e-3; // m; a light inside the surface is at this distance
    LightSample s;
    vec3 offset = light.position - position;
    float metres;
    float falloff = 1.0;
    if (light.kind == LIGHT_DIRECTIONAL)
    {
        s.direction = light.direction;
        metres = max(dot(offset, light.direction), 0.0);
    }
    else
    {
        float length_m = length(offset);
        metres = max(length_m, nearest);
        s.direction = offset / metres;
        if (light.kind == LIGHT_POINT)
        {
            float ratio = light.reference_distance / metres;
            falloff = ratio * ratio;
        }
    }
    s.strength = falloff * light.strength;
    s.source = light.strength;
    s.distance = max(light.distance_scale * metres + light.distance_offset, 0.0);
    return s;
}

// The three terms apart, so that a shader that leaves one out does not compute it. `local` is transpose(frame) * direction.
// Shadow belongs on the first and the last; eq. (6) is light that came through the skin, and the paper leaves it unshadowed.
vec3 surface_diffuse(ShadingParams p, LightSample light, vec3 albedo, vec3 local_light)
{
    return p.rho_d * max(local_light.z, 0.0) * albedo * light.strength;
}

vec3 subsurface_diffuse(uint model, ShadingParams p, LightSample light, vec3 albedo)
{
    return p.rho_ts * translucency_weight(model, p, light.distance) * albedo * light.source;
}

vec3 specular(uint model, ShadingParams p, LightSample light, vec3 local_light, vec3 local_viewer)
{
    return p.rho_s * ward_times_cosine(model, local_light, local_viewer, p.slope) * light.strength;
}

#endif
