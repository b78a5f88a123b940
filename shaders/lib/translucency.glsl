// Choi & Chin 2014, eq. (6): w = 1 / (alpha d + beta)^gamma, and a bounded sibling.
#ifndef LIB_TRANSLUCENCY_GLSL
#define LIB_TRANSLUCENCY_GLSL
#include "shared/shading.h"

// d >= 0: distance to the light in the paper's unit.
//
// The published weight is 17.8 at d = 0 with the paper's values: skin near the light gives back more than it gets. The
// bounded one is (w^-4 + W^-4)^(-1/4): below W everywhere, and off by the share (w/W)^4 / 4 at most where w is small.
// The exponent of the published one stops at 2^60, so that alpha d + beta near 0 stays finite.
float translucency_weight(uint model, ShadingParams p, float d)
{
    float exponent = clamp(-p.gamma * log2(max(p.alpha * d + p.beta, 1e-30)), -120.0, 60.0); // log2 w
    float published = exp2(exponent);
    if (model == TRANSLUCENCY_PUBLISHED)
        return published;
    if (p.translucency_bound <= 0.0)
        return 0.0;
    // The smaller of w and W times (1 + (smaller / larger)^4)^(-1/4): no power can overflow.
    float apart = abs(exponent - log2(p.translucency_bound));
    return min(published, p.translucency_bound) * inversesqrt(sqrt(1.0 + exp2(-4.0 * apart)));
}

#endif
