// The forward pass's parameters of one part of the head; the same bytes in C++ and GLSL (scalar layout).
#ifndef SHARED_PART_H
#define SHARED_PART_H
#include "glsl.h"
#ifdef __cplusplus
namespace shared {
#endif

struct Part
{
    vec4 albedo_factor;  // multiplies the albedo map; linear
    float normal_scale;  // glTF: multiplies the normal map's x and y
    float specular;      // multiplies rho_s: an eye is smooth, a brow has no highlight
    float slope;         // multiplies the slopes of Ward's lobe
    float grazing;       // SPECULAR_SKIN: c of ambient_specular() for the part's slopes
    float translucency;  // multiplies rho_ts
    float scattering;    // 1: light enters, as it does skin; 0: it does not
};

#ifdef __cplusplus
} // namespace shared
#endif
#endif
