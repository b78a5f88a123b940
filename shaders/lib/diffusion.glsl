// Light that spreads through the tissue, by Burley's profile (Christensen & Burley 2015): within r of where it entered
// leaves 1 - e^(-r/d) / 4 - 3 e^(-r/3d) / 4 of it. The light from a point's surroundings, farther than a texel, is kept on
// the skin's atlas (skin_diffused.comp); light from nearer is taken to leave where it entered.
#ifndef LIB_DIFFUSION_GLSL
#define LIB_DIFFUSION_GLSL
#include "lib/transport.glsl"

// own: the light that would leave, if light left where it entered. around: rgb: the light that the surroundings receive,
// per reflectance; a: mm, the radius beyond which they begin.
vec3 with_surroundings(DiffuseSkin skin, vec3 own, vec4 around)
{
    return mix(skin.albedo * around.rgb, own, left_within(skin.width, 1e-3 * around.a));
}

#endif
