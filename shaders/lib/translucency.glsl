// Choi & Chin 2014, eq. (6): w = 1 / (alpha d + beta)^gamma, and a bounded sibling.
#ifndef LIB_TRANSLUCENCY_GLSL
#define LIB_TRANSLUCENCY_GLSL
#include "shared/shading.h"

// d >= 0: distance to the light in the paper's unit.
//
// The published weight is 17.8 at d = 0 with the paper's values: skin near the light gives back more than it gets. The
// bounded one is (w^-4 + W^-4)^(-1/4): below W everywhere, and off by the share (w/W)^4 / 4 at most where w is small.
// w is held within 2^-31 .. 2^31, so that no fourth power overflows and alpha d + beta near 0 stays finite.
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
