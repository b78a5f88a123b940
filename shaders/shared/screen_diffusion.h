// Parameters of the passes that spread light in the picture; the same bytes in C++ and GLSL (scalar layout).
#ifndef SHARED_SCREEN_DIFFUSION_H
#define SHARED_SCREEN_DIFFUSION_H
#include "glsl.h"
#ifdef __cplusplus
namespace shared {
#define CONSTANT constexpr int
#define NUMBER constexpr float
#else
#define CONSTANT const int
#define NUMBER const float
#endif

CONSTANT SEPARABLE_TAPS = 25;   // along each axis, odd; as many as the authors use for close-ups
NUMBER SEPARABLE_REACH = 12.0;  // widths of the profile, of the outermost tap: .2 % of an edge's light is beyond
CONSTANT PICTURE_REACH = 256;   // pixels: light spreads no farther, which limits extreme close-ups alone; even
NUMBER PIXELS_PER_SAMPLE = 4.0; // of TRANSPORT_BURLEY: of a disc that covers fewer pixels fewer samples are taken

/// A tile of the picture, for what reads its neighbours.
struct PictureTile
{
    vec2 low, high;     // pixels of the tile: what of the picture lies in it
    ivec2 corner;       // pixels of the picture: the tile's first
    float pixels_at_1m; // of a metre that faces the camera one metre away
    vec3 scattering;    // m: times a pixel's reflectance the width of Burley's profile
};

/// optics::separable_kernel(). rgb: weight; a: place, in widths of the widest channel.
struct SeparableKernel
{
    vec4 taps[SEPARABLE_TAPS];
};

#undef CONSTANT
#undef NUMBER
#ifdef __cplusplus
} // namespace shared
#endif
#endif
