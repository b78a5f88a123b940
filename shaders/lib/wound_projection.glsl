// Projects wounds onto the skin in object space: texture seams do not matter, and many wounds can sit on one head.
#ifndef LIB_WOUND_PROJECTION_GLSL
#define LIB_WOUND_PROJECTION_GLSL
#include "lib/blend.glsl"
#include "shared/frame.h"

struct SkinPoint
{
    vec3 albedo;     // C of eq. (4)
    vec3 normal;     // unit
    float occlusion; // 1 open
    float wetness;   // 0 dry skin .. 1 open bed
    float tautness;  // 0 porous skin .. 1 new epithelium
};

// A patch is drawn much smaller than it is stored when the whole face is seen, and graph images have no mip levels: two
// bilinear taps across the pixel's footprint keep a film from sparkling.
vec4 patch_sample(sampler2D map, vec2 uv, vec2 footprint)
{
    return 0.5 * (textureLod(map, uv + footprint, 0) + textureLod(map, uv - footprint, 0));
}

struct WoundPlace
{
    vec2 uv;      // of the wound's images
    float facing; // how much of the wound the surface receives there, 0..1; 0 beside the images
};

// Where a point of the head, in metres, lies in a wound's images. `geometric`: the interpolated normal, which decides what the
// projection reaches; steep flanks fade out rather than smear. `facing` in double precision: passes::share_received().
WoundPlace project_wound(WoundFrame w, vec3 position, vec3 geometric)
{
    const vec3 d = (position - w.centre) / w.half_width;
    const vec2 uv = w.uv_scale * vec2(dot(d, w.right), dot(d, w.down)) + w.uv_offset;
    const float height = abs(dot(d, w.normal)) / w.reach;
    const float facing = smoothstep(0.15, 0.45, dot(geometric, w.normal)) * (1 - smoothstep(0.8, 1.0, height));
    return WoundPlace(uv, any(greaterThan(abs(uv - 0.5), vec2(0.5))) ? 0 : facing);
}

void add_wound(uint blend_model, WoundFrame w, sampler2D color_map, sampler2D state_map, sampler2D relief_map, sampler2D lut,
               vec3 position, vec3 geometric, inout SkinPoint skin)
{
    const WoundPlace place = project_wound(w, position, geometric);
    const vec2 uv = place.uv;
    const vec2 footprint = 0.25 * (dFdx(uv) + dFdy(uv)); // before any branch: derivatives need the whole quad
    const float facing = place.facing;
    if (facing <= 0)
        return;
    const vec4 color = patch_sample(color_map, uv, footprint);
    const float opacity = color.a * facing;
    if (opacity <= 0)
        return;
    const vec4 state = textureLod(state_map, uv, 0);
    const float recovery = mix(w.border_recovery, w.bed_recovery, state.b);
    const vec4 relief = patch_sample(relief_map, uv, footprint);

    const vec3 reflectance = textureLod(lut, lut_uv(w.lut, state.r, w.day, vec2(textureSize(lut, 0))), 0).rgb;
    // Between the bed and the outer border lies new epithelium: thin, so that the blood beneath shows. Its W is that, not the photo's bed.
    const float ring_share = clamp(state.a - state.b, 0, 1);
    // The inflamed rim turns into it as well, as soon as there is any.
    const float renewed = w.epithelium * (1 - state.b) * clamp(8 * recovery, 0, 1);
    const vec3 wound = mix(color.rgb, skin.albedo * w.new_skin, renewed);
    skin.albedo = mix(skin.albedo, recovering_color(blend_model, wound, reflectance, skin.albedo, recovery), opacity);

    const float fresh = 1 - clamp(recovery, 0, 1); // how much of the injury is still to be seen
    const float bed = state.b * opacity, ring = ring_share * opacity;
    // New epithelium has few pores; the bed is uneven in a way of its own, which the pores stand for. The hollow bends the normal: height is -depth.
    const vec3 smoothed = mix(skin.normal, geometric, fresh * clamp(0.4 * bed + 0.6 * ring, 0, 1));
    skin.normal = normalize(smoothed + facing * (relief.x * w.right + relief.y * w.down));
    skin.occlusion *= mix(1.0, relief.z, facing);
    skin.wetness = max(skin.wetness, bed * sqrt(fresh));
    skin.tautness = max(skin.tautness, ring * fresh);
}

#endif
