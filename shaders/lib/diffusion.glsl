// Light that spreads through the tissue, by Burley's profile (Christensen & Burley 2015): within r of where it entered
// leaves 1 - e^(-r/d) / 4 - 3 e^(-r/3d) / 4 of it. The light from a point's surroundings, farther than a texel, is kept on
// the skin's atlas (skin_diffused.comp); light from nearer is taken to leave where it entered.
#ifndef LIB_DIFFUSION_GLSL
#define LIB_DIFFUSION_GLSL
#include "lib/transport.glsl"

// Same unit. In double precision: optics::left_within().
vec3 left_within(vec3 width, float radius)
{
    vec3 t = exp(-radius / (3.0 * width));
    return 1.0 - t * (t * t + 3.0) / 4.0;
}

// own: the light that would leave, if light left where it entered. around: rgb: the light that the surroundings receive,
// per reflectance; a: mm, the radius beyond which they begin.
vec3 with_surroundings(DiffuseSkin skin, vec3 own, vec4 around)
{
    return mix(skin.albedo * around.rgb, own, left_within(skin.width, 1e-3 * around.a));
}

#endif
