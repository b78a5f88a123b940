// Parameters of the passes that keep light on the skin's atlas; the same bytes in C++ and GLSL (scalar layout).
#ifndef SHARED_SKIN_H
#define SHARED_SKIN_H
#include "glsl.h"
#ifdef __cplusplus
namespace shared {
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

/// Of the camera's pass.
struct Develop
{
    float exposure; // factor on linear light
    vec2 size;      // of the picture, pixels
    vec3 top, bottom; // the backdrop's colours, linear, not exposed
};

#ifdef __cplusplus
} // namespace shared
#endif
#endif
