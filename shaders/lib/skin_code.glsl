// How the skin's maps code what they hold.
#ifndef LIB_SKIN_CODE_GLSL
#define LIB_SKIN_CODE_GLSL
#include "lib/frame.glsl"
#include "lib/wound_projection.glsl"

const float SPREAD_WHITE = 0.5; // largest slope variance

// rgb: root of the reflectance; a: share of the surroundings that the head lets through.
vec4 coded_albedo(vec3 albedo, float open) { return vec4(sqrt(clamp(albedo, 0.0, 1.0)), open); }
// Wetness, tautness, slope variance, occlusion by the wound's hollow.
vec4 coded_gloss(SkinPoint skin)
{
    return vec4(skin.wetness, skin.tautness, sqrt(min(skin.slope_variance / SPREAD_WHITE, 1.0)), skin.occlusion);
}

// A point of which only this is known.
SkinPoint decoded_gloss(vec4 gloss)
{
    return SkinPoint(vec3(0.0), vec3(0.0), gloss.a, gloss.r, gloss.g, SPREAD_WHITE * gloss.b * gloss.b);
}

SkinPoint decoded_skin(vec3 albedo, vec3 normal, vec4 gloss)
{
    SkinPoint skin = decoded_gloss(gloss);
    skin.albedo = albedo * albedo;
    skin.normal = normalize_or(normal * 2.0 - 1.0, vec3(0.0, 0.0, 1.0));
    return skin;
}

#endif
