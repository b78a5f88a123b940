// The bed's colour in the healing phases; the double-precision reference is wound/healing/phases.cpp.
#ifndef LIB_PHASES_GLSL
#define LIB_PHASES_GLSL
#include "shared/wound.h"

// Linear Rec. 709.
const vec3 CLOT_COLOR = vec3(0.085, 0.014, 0.011), FIBRIN_COLOR = vec3(0.54, 0.39, 0.20), GRANULATION_COLOR = vec3(0.37, 0.045, 0.042);

// How far (0..1) a texel has changed when `share` of the bed has; texels of rank 1 change first.
float turned(float share, float rank) { return smoothstep(1 - 1.5 * share, 1.5 - 1.5 * share, rank); }

// Relative to the median of the bed.
float light_of(vec3 color, BedPhase phase)
{
    return max(dot(color, vec3(0.2126, 0.7152, 0.0722)), 1e-4) / max(phase.bed_luminance, 1e-4);
}

// `around`: the mean colour near the texel, which decides what it turns into.
vec3 tinted(vec3 color, vec3 around, BedPhase phase)
{
    const float paleness = clamp(0.5 + 0.25 * log2(light_of(around, phase)), 0.0, 1.0); // 0..1 for 1/4 .. 4 times the median
    const float redness = clamp(1 - 2 * around.g / max(around.r, 1e-4), 0.0, 1.0);
    const float relief = sqrt(clamp(light_of(color, phase), 0.35, 1.8)); // the texture of the bed shows through
    color = mix(color, CLOT_COLOR * relief, 0.8 * turned(phase.clot, 1 - paleness));
    color = mix(color, FIBRIN_COLOR * relief, 0.65 * turned(phase.fibrin, paleness * (1 - 0.5 * redness))); // clean red beds stay so
    return mix(color, GRANULATION_COLOR * relief, 0.72 * turned(phase.granulation, redness));
}

#endif
