// One evaluation of a formula of shaders/lib, for the test that compares them with the double-precision reference.
#ifndef TESTS_SHADING_CASE_H
#define TESTS_SHADING_CASE_H
#include "../../shaders/shared/shading.h"
#ifdef __cplusplus
namespace shared {
#define CONSTANT constexpr uint
#else
#define CONSTANT const uint
#endif

CONSTANT FORMULA_WARD = 0;             // a = i, b = o, params.slope -> x
CONSTANT FORMULA_TRANSLUCENCY = 1;     // number = d -> x
CONSTANT FORMULA_BLEND = 2;            // a = W, b = R, c = S, number = recovery
CONSTANT FORMULA_SRGB_FROM_LINEAR = 3; // a
CONSTANT FORMULA_LINEAR_FROM_SRGB = 4; // a
CONSTANT FORMULA_SHOULDER = 5;         // a
CONSTANT FORMULA_TANGENT = 6;          // a = normal, b and number = tangent
CONSTANT FORMULA_BITANGENT = 7;
CONSTANT FORMULA_NORMAL = 8;
CONSTANT FORMULA_BEND = 9;             // a = normal, b = to viewer
CONSTANT FORMULA_SHADE = 10;           // a = position, b = to viewer, c = albedo, number = visibility; frame of the normal
CONSTANT FORMULA_VISIBILITY = 11;       // number = open, a = albedo
CONSTANT FORMULA_AMBIENT_SPECULAR = 12; // number = cosine -> x
CONSTANT FORMULA_SPECULAR_OCCLUSION = 13; // number = open, a.x = cosine -> x; a.y = cosine of above_horizon() -> y, of bounced_share() -> z
CONSTANT FORMULA_SURROUNDINGS_LEFT = 14; // a = albedo, b = seen, transport, curvature, thinness
CONSTANT FORMULA_DIPOLE = 15; // a = transport, b = depth, c = image, number = r^2

struct ShadingCase
{
    uint formula;
    uint model;        // of the formula; of Ward for FORMULA_SHADE
    uint translucency; // model, FORMULA_SHADE only
    uint specular;     // model, FORMULA_SHADE only
    uint transport;    // FORMULA_SHADE only, as what follows
    vec2 curvature;
    float thinness;
    float filter_m, through_m;
    vec3 smooth_normal;
    float number;
    float wetness, slope_variance; // of the last two formulas and FORMULA_SHADE
    vec3 a, b, c;
    ShadingParams params;
    Light light;
};

#undef CONSTANT
#ifdef __cplusplus
} // namespace shared
#endif
#endif
