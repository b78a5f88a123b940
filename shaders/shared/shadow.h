// The key light's shadow map: maps a point of the world to the light's depth image.
#ifndef SHARED_SHADOW_H
#define SHARED_SHADOW_H
#include "glsl.h"
#ifdef __cplusplus
namespace shared {
#endif

struct Shadow
{
    mat4 clip_from_world;       // Vulkan clip space of the light: x right, y down, depth 0..1
    mat4 clip_plane_from_world; // the same for planes (normal, -distance): its inverse, transposed
    float texel;                // width of a texel, m, per unit of clip w: at clip w = 1 for a parallel light
    float size;                 // texels along an edge of the depth image
};

#ifdef __cplusplus
} // namespace shared
#endif
#endif
