// The importance of a texel of the atlas for what the skin around it shows: the light that it sends in (Chang et al. 2008).
#ifndef LIB_CHANG_GLSL
#define LIB_CHANG_GLSL
#include "shared/chang.h"

layout(binding = 0) uniform sampler2D home;       // mm; a: mm^2, area of the texel, 0: no skin
layout(binding = 1) uniform sampler2D irradiance; // what the skin receives, per reflectance

// 0 beside the atlas.
float importance(ivec2 texel)
{
    if (any(greaterThanEqual(texel, textureSize(home, 0))))
        return 0.0;
    const vec3 light = max(texelFetch(irradiance, texel, 0).rgb, vec3(0.0));
    return (light.r + light.g + light.b) * texelFetch(home, texel, 0).a;
}

#endif
