// What the forward pass is told each frame; the same bytes in C++ and GLSL (scalar layout).
#ifndef SHARED_FRAME_H
#define SHARED_FRAME_H
#include "glsl.h"
#include "reflectance_lut.h"
#ifdef __cplusplus
namespace shared {
#endif

// Four textures each, and the head's own four, make the 32 samplers that lavapipe allows a shader. (Beyond them it takes one
// sampler for another.)
#ifdef __cplusplus
constexpr uint MAX_WOUNDS = 7;
#else
const uint MAX_WOUNDS = 7;
#endif

struct View
{
    mat4 clip_from_world;
    vec3 eye; // metres
};

/// Where a wound's patch lies on the head, and how far it is today.
struct WoundFrame
{
    vec3 centre;      // metres
    float half_width; // metres, of the patch
    vec3 right;       // unit
    float reach;      // skin further from the patch's plane than this receives nothing; in half widths
    vec3 down;        // unit
    float day;
    vec3 normal;      // unit
    vec2 uv_scale;    // patch coordinates, -1..1, to the uv of the wound's images, which hold a region of the patch
    vec2 uv_offset;
    float bed_recovery;    // r of eq. (4) in the open bed
    float border_recovery; // r of eq. (4) in the rim
    LutAxes lut;      // of the wound's reflectance table
    float epithelium; // 1 when new epithelium covers what lies between bed and border, 0 when the border itself closes
    float pore_loss;  // of new epithelium and scar: 1 no pores or fine lines .. 0 as skin
    float sheen;      // 1 as smooth and shiny as new epithelium .. 0 as skin
};

#ifdef __cplusplus
} // namespace shared
#endif
#endif
