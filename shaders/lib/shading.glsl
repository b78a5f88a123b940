// Choi & Chin 2014, eq. (8), per light: Lambert (5), translucency (6), Ward (7). Linear Rec. 709.
#ifndef LIB_SHADING_GLSL
#define LIB_SHADING_GLSL
#include "lib/specular.glsl"
#include "lib/translucency.glsl"
#include "lib/transport.glsl"
#include "shared/shading.h"

struct LightSample
{
    vec3 direction; // unit, towards the light
    vec3 strength;  // I at the point: radiance of a white diffuser at the point that faces the light
};

// Distance in m to the light, at least 1 mm, or to a directional light's plane, at least 0.
float light_distance(Light light, vec3 position)
{
    vec3 offset = light.position - position;
    return light.kind == LIGHT_DIRECTIONAL ? max(dot(offset, light.direction), 0.0) : max(length(offset), 1e-3);
}

LightSample sample_light(Light light, vec3 position)
{
    if (light.kind == LIGHT_DIRECTIONAL)
        return LightSample(light.direction, light.strength);
    vec3 offset = light.position - position;
    float per_metre = min(inversesqrt(max(dot(offset, offset), 1e-30)), 1e3); // light_distance()'s bound
    float ratio = light.kind == LIGHT_POINT ? light.reference_distance * per_metre : 1.0;
    return LightSample(offset * per_metre, ratio * ratio * light.strength);
}

// The three terms of eq. (8) are separate functions, so that a shader computes only those it uses: leaving()
// (lib/transport.glsl) is the diffuse one. Apply shadow to the highlight (lib/specular.glsl); the paper does not shadow
// translucent light. local = direction * mat3(t, b, n).

// Without the albedo C. Uses I at the reference distance, because eq. (6) is the fall-off. It varies so
// slowly over the surface that it is evaluated per vertex: for vertices 3 mm apart the error is below .1 %.
vec3 subsurface_diffuse(uint model, ShadingParams p, Light light, vec3 position)
{
    float d = light.distance_scale * light_distance(light, position);
    return p.rho_ts * translucency_weight(model, p, d) * light.strength;
}

// Jimenez et al. 2016, "Practical Real-Time Strategies for Accurate Indirect Occlusion": the share of its surroundings
// that a point sees when light goes back and forth in the hollow. `open`: without that; `albedo`: of the hollow.
vec3 visibility(float open, vec3 albedo)
{
    vec3 a = 2.0404 * albedo - 0.3324, b = 0.6417 - 4.7951 * albedo, c = 2.7552 * albedo + 0.6903;
    return max(vec3(open), ((open * a + b) * open + c) * open);
}

// Light of a lamp that reaches a point by way of the skin that hides the rest of its surroundings: times the lamp's strength
// without its shadow, and times the skin's diffuse albedo. `cosine` between normal and lamp.
float bounced_share(float open, float cosine) { return BOUNCED_SHARE * (1.0 - open) * (0.5 + 0.5 * cosine); }

#endif
