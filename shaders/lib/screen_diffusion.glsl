// Light that spreads in the picture: what the forward pass hands out of the skin, per pixel. With several samples per pixel
// these are means over them, all weighted by the share of the pixel that is skin and not behind hair.
#ifndef LIB_SCREEN_DIFFUSION_GLSL
#define LIB_SCREEN_DIFFUSION_GLSL
#include "shared/screen_diffusion.h"

layout(binding = 0) uniform sampler2D received;    // rgb: light that the skin receives, per reflectance; a: share that is no skin
layout(binding = 1) uniform sampler2D reflectance; // rgb: rho_d C
layout(binding = 2) uniform sampler2D distances;   // r: m, along the camera's axis
layout(binding = 3) uniform sampler2D specular;    // the picture without what leaves the skin diffusely
layout(scalar, binding = 4) uniform Tile_ { PictureTile tile; };

const float LEAST_SKIN = 1.0 / 1024.0; // share of a pixel that counts as skin

struct SkinPixel
{
    float share; // of the pixel
    vec3 light, albedo;
    float distance_m;
    vec3 width; // m, of Burley's profile
};

SkinPixel skin_pixel(ivec2 p)
{
    const vec4 light = texelFetch(received, p, 0);
    const float share = 1.0 - light.a, per_share = 1.0 / max(share, LEAST_SKIN);
    const vec3 albedo = per_share * texelFetch(reflectance, p, 0).rgb;
    return SkinPixel(share, per_share * light.rgb, albedo, per_share * texelFetch(distances, p, 0).r,
                     max(albedo * tile.scattering, vec3(1e-6)));
}

// Pixels per width of the widest channel. reach: widths, to the outermost sample.
float pixels_per_width(SkinPixel here, float reach)
{
    const float widest = max(max(here.width.r, here.width.g), here.width.b);
    return min(widest * tile.pixels_at_1m / max(here.distance_m, 1e-3), float(PICTURE_REACH - 1) / reach);
}

#endif
