// Label values of a pixel, and the label pass's parameters; the same bytes in C++ and GLSL (scalar layout).
#ifndef SHARED_LABELS_H
#define SHARED_LABELS_H
#include "glsl.h"
#ifdef __cplusplus
namespace shared {
#define CONSTANT constexpr uint
#else
#define CONSTANT const uint
#endif

CONSTANT LABEL_BACKGROUND = 0;
CONSTANT LABEL_SKIN = 1;
CONSTANT LABEL_OPEN_BED = 2;
CONSTANT LABEL_NEW_EPITHELIUM = 3; // inside the outer border but closed: new epithelium, later scar
CONSTANT LABEL_OTHER = 4;          // eyes, mouth, clothes, solid hair

struct LabelCamera
{
    vec3 eye;         // metres
    vec3 forward;     // unit
    float pixel_area; // area of a pixel at unit depth: 1 / (fx fy)
};

#undef CONSTANT
#ifdef __cplusplus
} // namespace shared
#endif
#endif
