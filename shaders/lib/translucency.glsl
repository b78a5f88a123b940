// Choi & Chin 2014, eq. (6): w = 1 / (alpha d + beta)^gamma, and a bounded variant.
#ifndef LIB_TRANSLUCENCY_GLSL
#define LIB_TRANSLUCENCY_GLSL
#include "shared/shading.h"

// d >= 0: distance to the light in the paper's unit.
//
// With the paper's values the published weight is 17.8 at d = 0: skin near the light emits more than it
// receives. The bounded weight (w^-4 + W^-4)^(-1/4) is below W everywhere; for small w its relative error is
// at most (w/W)^4 / 4. w is clamped to 2^-31 .. 2^31, so that fourth powers and alpha d + beta near 0 stay
// finite.
float translucency_weight(uint model, ShadingParams p, float d)
{
    float exponent = p.gamma * log2(max(p.alpha * d + p.beta, 1e-30)); // log2(1/w)
    float inverse = exp2(clamp(exponent, -31.0, 31.0));
    if (model == TRANSLUCENCY_PUBLISHED)
        return 1.0 / inverse;
    float square = inverse * inverse;
    return inversesqrt(sqrt(square * square + p.translucency_bound_4));
}

#endif
