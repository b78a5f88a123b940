// Shading parameters, eqs. (4)-(8) of Choi & Chin 2014; wound/optics/shading.hpp explains and checks each
// value.
#ifndef SHARED_SHADING_H
#define SHARED_SHADING_H
#include "glsl.h"
#ifdef __cplusplus
namespace shared {
#define CONSTANT constexpr uint
#else
#define CONSTANT const uint
#endif

// Values of the enums of wound/optics/shading.hpp; a specialisation constant of the shader selects one.
CONSTANT WARD_PUBLISHED = 0;
CONSTANT WARD_DUER = 1;
CONSTANT WARD_BOUNDED = 2;
CONSTANT TRANSLUCENCY_PUBLISHED = 0;
CONSTANT TRANSLUCENCY_BOUNDED = 1;
CONSTANT BLEND_PUBLISHED = 0;
CONSTANT BLEND_CORRECTED = 1;
CONSTANT LIGHT_DIRECTIONAL = 0;
CONSTANT LIGHT_POINT = 1;
CONSTANT LIGHT_POINT_WITHOUT_FALLOFF = 2;
CONSTANT MAX_LIGHTS = 8;

struct ShadingParams
{
    float rho_d, rho_ts, rho_s;     // diffuse, translucent, specular; 0..1
    float alpha, beta, gamma;       // eq. (6), for distances in the paper's unit
    float translucency_bound_4;     // W^-4, W the largest weight of the bounded translucency; 1e36 for W = 0
    vec2 slope;                     // alpha_x, alpha_y of eq. (7), 1e-4..1.5
    vec3 ambient;                   // rho_d x linear radiance of the surroundings; multiplied by ambient occlusion
};

struct Light
{
    vec3 position;            // m; directional: a point of the plane of distance 0
    uint kind;                // LIGHT_...
    vec3 direction;           // unit, towards the light; directional only
    float reference_distance; // m
    vec3 strength;            // linear radiance of a white diffuser facing the light at reference_distance
    float distance_scale;     // paper's units per metre
    float distance_offset;    // paper's units
};

struct Lighting
{
    uint count; // lights in use
    Light light[MAX_LIGHTS];
};

#undef CONSTANT
#ifdef __cplusplus
} // namespace shared
#endif
#endif
