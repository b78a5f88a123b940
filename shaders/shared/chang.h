// Parameters of transport `chang`; the same bytes in C++ and GLSL (scalar layout).
#ifndef SHARED_CHANG_H
#define SHARED_CHANG_H
#include "glsl.h"
#ifdef __cplusplus
namespace shared {
#define CONSTANT constexpr int
#else
#define CONSTANT const int
#endif

CONSTANT CHANG_SAMPLES = 400; // of all the skin, for all pixels
CONSTANT CHANG_LEVELS = 7;    // of the pyramid, each a quarter as wide and high as the one before: for an atlas of 16384 texels

/// Of the skin, per channel.
struct Dipole
{
    vec3 transport;    // sigma_tr, 1/mm
    vec3 depth, image; // mm, of the sources from the surface
    vec3 per_total;    // 1 / (integral over the plane)
};

/// Of a picture.
struct ChangView
{
    Dipole dipole;
    vec3 eye;                  // mm
    vec3 right, down, forward; // unit
    vec2 centre;               // pixels of the tile: the picture's middle
    float local_mm;            // nearer light is gathered in the picture
    vec3 local_share;          // of all light
    vec4 taps[64];             // optics::diffusion_taps(), over the last one's radius, z as it is; w: unused
};

#undef CONSTANT
#ifdef __cplusplus
} // namespace shared
#endif
#endif
