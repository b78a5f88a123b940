// One stack of layers and an analytic model, for the test of the shader's single precision.
#ifndef TESTS_REFLECTANCE_CASE_H
#define TESTS_REFLECTANCE_CASE_H
#include "../../shaders/shared/glsl.h"
#ifdef __cplusplus
namespace shared {
#endif

struct ReflectanceLayer
{
    float sigma_a;         // mm^-1
    float sigma_s_reduced; // mm^-1
    float g;
    float n;
    float thickness_mm;
};

struct ReflectanceCase
{
    uint model; // of lib/reflectance.glsl
    uint first; // of its layers, from the top down
    uint count;
    float n_above;
    float n_below;
};

#ifdef __cplusplus
} // namespace shared
#endif
#endif
