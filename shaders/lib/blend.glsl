// Choi & Chin 2014, eq. (4): colour of a recovering wound from its texture W, layered reflectance R and skin
// S.
#ifndef LIB_BLEND_GLSL
#define LIB_BLEND_GLSL
#include "shared/shading.h"

// recovery: 0 fresh .. 1 healed. All weights are >= 0 and sum to 1 in both models. The published model ends
// at .2 W + .4 R + .4 S; the corrected one keeps the root terms and is W at 0, S at 1.
vec3 recovering_color(uint model, vec3 wound, vec3 reflectance, vec3 skin, float recovery)
{
    float r = clamp(recovery, 0.0, 1.0); // sqrt is undefined below 0
    float root = sqrt(r);
    if (model == BLEND_PUBLISHED)
        return (1.0 - 0.8 * root) * wound + 0.8 * root * reflectance + 0.4 * r * (skin - reflectance);
    float of_reflectance = max(0.8 * (root - r), 0.0); // sqrt(1) may round below 1
    return (1.0 - (of_reflectance + r)) * wound + of_reflectance * reflectance + r * skin;
}

#endif
