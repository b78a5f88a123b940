// From linear light to an sRGB-coded pixel.
#ifndef LIB_DEVELOP_GLSL
#define LIB_DEVELOP_GLSL
#include "lib/color.glsl"
#include "shared/skin.h"

vec3 developed(Develop develop, vec3 radiance)
{
    return srgb_from_linear(min(soft_shoulder(finite_radiance(radiance) * develop.exposure), 1.0));
}

#endif
