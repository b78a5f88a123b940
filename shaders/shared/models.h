// Models that a specialisation constant selects: the values of optics::ReflectanceModel that the shader
// implements, and of wound::WarpModel.
#ifndef SHARED_MODELS_H
#define SHARED_MODELS_H
#include "glsl.h"
#ifdef __cplusplus
namespace shared {
#define CONSTANT constexpr
#else
#define CONSTANT const
#endif

CONSTANT int REFLECTANCE_PRINTED = 0;
CONSTANT int REFLECTANCE_PUBLISHED = 1;
CONSTANT int REFLECTANCE_EXPONENTIAL = 2;
CONSTANT int REFLECTANCE_TWO_STREAM_PAPER = 3;
CONSTANT int REFLECTANCE_TWO_STREAM = 4;
CONSTANT int REFLECTANCE_CALIBRATED = 5;

CONSTANT uint WARP_RADIAL = 0;
CONSTANT uint WARP_GRID = 1;
CONSTANT uint WARP_DENSE = 2;
CONSTANT uint WARP_COMPOSED = 3;

#undef CONSTANT
#ifdef __cplusplus
} // namespace shared
#endif
#endif
