// Parameters of the passes that keep light on the skin's atlas; the same bytes in C++ and GLSL (scalar layout).
#ifndef SHARED_SKIN_H
#define SHARED_SKIN_H
#include "glsl.h"
#ifdef __cplusplus
namespace shared {
#define CONSTANT constexpr int
#else
#define CONSTANT const int
#endif

/// A draw on the atlas.
struct AtlasDraw
{
    vec2 skirt;     // how far a skirt reaches beyond its chart's border, as a share of the image's size
    vec2 low, high; // texels, of the tile; nothing is drawn outside
};

/// How the light map codes linear light: sqrt(light / white).
struct LightCode
{
    float white;
};

/// A draw of head::AtlasSurface.
struct SurfaceDraw
{
    vec2 size;      // of the atlas, units
    float skirt;    // width of the skirts, units
    vec2 low, high; // texels, of the tile; nothing is drawn outside
};

CONSTANT BACKDROP_BANDS = 12;

CONSTANT DIFFUSION_TAPS = 64;
CONSTANT DIFFUSION_REACH = 32; // texels along each side; taps farther away are left out

/// How far light spreads in the skin.
struct Diffusion
{
    vec3 scattering_mm; // rho_d x optics::scattering_length_mm(): times C of eq. (4) the width of Burley's profile
    vec4 taps[DIFFUSION_TAPS]; // optics::diffusion_taps(); w: unused
};

/// Of the camera's pass.
struct Develop
{
    float exposure; // factor on linear light
    vec2 size;      // of the picture, pixels
    vec3 top, bottom; // the backdrop's colours, linear, not exposed
};

#undef CONSTANT
#ifdef __cplusplus
} // namespace shared
#endif
#endif
