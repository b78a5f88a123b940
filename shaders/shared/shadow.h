// A light's shadow map: maps a point of the world to the light's tile of the depth image.
#ifndef SHARED_SHADOW_H
#define SHARED_SHADOW_H
#include "glsl.h"
#ifdef __cplusplus
namespace shared {
#endif

struct Shadow
{
    mat4 clip_from_world;       // Vulkan clip space of the depth image: x right, y down, depth 0..1
    mat4 clip_plane_from_world; // the same for planes (normal, -distance): its inverse, transposed
    float texel;                // width of a texel, m, per unit of clip w: at clip w = 1 for a parallel light
    vec2 step;                  // width and height of a texel in clip space, at clip w = 1
};

#ifdef __cplusplus
} // namespace shared
#endif
#endif
