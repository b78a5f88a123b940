// Projects wounds onto the skin in object space, so that texture seams do not matter and a head can have
// several.
#ifndef LIB_WOUND_PROJECTION_GLSL
#define LIB_WOUND_PROJECTION_GLSL
#include "lib/blend.glsl"
#include "shared/frame.h"
#include "shared/part.h"

struct SkinPoint
{
    vec3 albedo;     // C of eq. (4)
    vec3 normal;     // unit
    float occlusion; // of the wounds' hollows: 1 open
    float wetness;   // 0 dry skin .. 1 open bed
    float tautness;  // 0 porous skin .. 1 new epithelium
    float slope_variance; // of Finish
};

// Parameters of the highlight here: of the part, of taut new epithelium, whose lobe is slightly narrower, and with
// SPECULAR_WARD, which knows no film, of a wet bed, whose lobe is narrower and dimmer. wound::with_gloss().
// only_ward: eq. (7) as published knows neither.
ShadingParams with_gloss(uint specular_model, bool only_ward, ShadingParams p, Part part, SkinPoint skin)
{
    const float wet = specular_model == SPECULAR_WARD && !only_ward ? 0.4 * skin.wetness : 0;
    const float taut = only_ward ? 0 : skin.tautness;
    const float gloss = part.specular * (1 - wet + 0.15 * taut);
    p.slope *= part.slope * (1 - wet) * (1 - 0.25 * taut);
    p.rho_s *= gloss;
    p.fresnel_scale *= gloss;
    p.mirrored *= gloss;
    p.grazing = part.grazing;
    return p;
}

// When the whole face is visible, a patch is strongly minified, and graph images have no mip levels: two
// bilinear taps across the pixel's footprint reduce flicker in videos.
vec4 patch_sample(sampler2D map, vec2 uv, vec2 footprint)
{
    return 0.5 * (textureLod(map, uv + footprint, 0) + textureLod(map, uv - footprint, 0));
}

struct WoundPlace
{
    vec2 uv;      // of the wound's images
    float facing; // share of the projection that the surface receives, 0..1; 0 outside the images
};

// Maps a point of the head, in metres, to a wound's images. `geometric`: the interpolated normal; the
// projection fades out on steep flanks, where it would smear. `facing` in double precision:
// head::share_received().
WoundPlace project_wound(WoundFrame w, vec3 position, vec3 geometric)
{
    const vec3 d = (position - w.centre) / w.half_width;
    const vec2 uv = w.uv_scale * vec2(dot(d, w.right), dot(d, w.down)) + w.uv_offset;
    const float height = abs(dot(d, w.normal)) / w.reach;
    const float facing = smoothstep(0.15, 0.45, dot(geometric, w.normal)) * (1 - smoothstep(0.8, 1.0, height));
    return WoundPlace(uv, any(greaterThan(abs(uv - 0.5), vec2(0.5))) ? 0 : facing);
}

vec3 tissue_reflectance(WoundFrame w, sampler2D lut, uint part, float injury_mm)
{
    return textureLod(lut, lut_uv(w.lut, part, injury_mm, w.day, vec2(textureSize(lut, 0))), 0).rgb;
}

const float INFLAMED_MM = 0.25; // the inflamed rim has the colour of a covered injury of this depth

// The face's skin, changed by a covered injury: multiplied by the table's colour over its colour without
// injury.
vec3 covered_skin(WoundFrame w, sampler2D lut, float injury_mm, vec3 skin)
{
    const vec3 unhurt = max(tissue_reflectance(w, lut, LUT_COVERED, 0), vec3(1e-3));
    return min(skin * tissue_reflectance(w, lut, LUT_COVERED, injury_mm) / unhurt, vec3(1));
}

void add_wound(uint blend_model, WoundFrame w, sampler2D color_map, sampler2D state_map, sampler2D relief_map, sampler2D lut,
               vec3 position, vec3 geometric, inout SkinPoint skin)
{
    const WoundPlace place = project_wound(w, position, geometric);
    const vec2 uv = place.uv;
    const vec2 footprint = 0.25 * (dFdx(uv) + dFdy(uv)); // before any branch: needs the whole quad
    const float facing = place.facing;
    if (facing <= 0)
        return;
    const vec4 color = patch_sample(color_map, uv, footprint);
    const float opacity = color.a * facing;
    if (opacity <= 0)
        return;
    const vec4 state = textureLod(state_map, uv, 0);
    const vec4 relief_after = textureLod(relief_map, uv + footprint, 0), relief_before = textureLod(relief_map, uv - footprint, 0);
    const vec4 relief = 0.5 * (relief_after + relief_before);

    // The photograph does not show the new epithelium between bed and border, so its W is R; its layers
    // already recover with the day, so r is 0 there. The intact rim is inflamed too; new_skin replaces the
    // photograph's colour there.
    const float renewed = w.epithelium * (1 - state.b), ring = w.epithelium * clamp(state.a - state.b, 0, 1);
    const float recovery = mix(w.border_recovery * (1 - w.epithelium * state.a), w.bed_recovery, state.b);
    const vec3 new_skin = renewed > 0 ? covered_skin(w, lut, max(state.g, INFLAMED_MM * (1 - state.a)), skin.albedo) : vec3(0);
    const vec3 wound = mix(color.rgb, new_skin, renewed);
    const vec3 reflectance = mix(tissue_reflectance(w, lut, LUT_OPEN, state.r), new_skin, renewed);
    skin.albedo = mix(skin.albedo, recovering_color(blend_model, wound, reflectance, skin.albedo, recovery), opacity);

    const float fresh = 1 - clamp(w.bed_recovery, 0, 1); // visible share of the bed
    const float bed = state.b * opacity, taut = ring * opacity;
    // The skin's pores approximate the unevenness of the bed. The hollow bends the normal: height is -depth.
    const vec3 smoothed = mix(skin.normal, geometric, clamp(0.4 * bed * fresh + w.pore_loss * taut, 0, 1));
    skin.normal = normalize(smoothed + facing * (relief.x * w.right + relief.y * w.down));
    skin.occlusion *= mix(1.0, relief.z, facing);
    skin.wetness = max(skin.wetness, bed * sqrt(fresh));
    skin.tautness = max(skin.tautness, w.sheen * taut);
    const vec2 off = facing * (relief_after.xy - relief_before.xy); // of two samples the variance is half its square
    skin.slope_variance += 0.5 * dot(off, off);
}

#endif
