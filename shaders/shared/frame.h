// Per-frame parameters of the forward pass; the same bytes in C++ and GLSL (scalar layout).
#ifndef SHARED_FRAME_H
#define SHARED_FRAME_H
#include "glsl.h"
#include "reflectance_lut.h"
#ifdef __cplusplus
namespace shared {
#endif

#ifdef __cplusplus
#define CONSTANT constexpr uint
#else
#define CONSTANT const uint
#endif

CONSTANT MAX_WOUNDS = 255; // of a scene: label images number them in a byte
// Wounds that one draw can show. Four textures of each and five of the head are nearly the 32 samplers that lavapipe
// allows per shader. (With more it confuses samplers.)
CONSTANT WOUNDS_HERE = 6;

struct View
{
    mat4 clip_from_world;
    vec3 eye; // metres
};

/// The position of a wound's patch on the head, and the wound's state today.
struct WoundFrame
{
    vec3 centre;      // metres
    float half_width; // metres, of the patch
    vec3 right;       // unit
    float reach;      // skin farther from the patch's plane receives no wound; in half widths
    vec3 down;        // unit
    float day;
    vec3 normal;      // unit
    vec2 uv_scale;    // uv of the wound's images, which hold a region of the patch,
    vec2 uv_offset;   // = uv_scale * patch coordinates (-1..1) + uv_offset
    float bed_recovery;    // r of eq. (4) in the open bed
    float border_recovery; // r of eq. (4) in the rim
    LutAxes lut;      // axes of the wound's reflectance table
    float epithelium; // 1: new epithelium covers the area between bed and border; 0: the border contracts
    float pore_loss;  // of new epithelium and scar: 1 no pores or fine lines .. 0 like skin
    float sheen;      // 1 as smooth and shiny as new epithelium .. 0 like skin
    uint number;      // of the wound in its scene, from 1
};

#undef CONSTANT
#ifdef __cplusplus
} // namespace shared
#endif
#endif
