// Parameters of the wound's two compute passes; the same bytes in C++ and GLSL (scalar layout).
#ifndef SHARED_WOUND_H
#define SHARED_WOUND_H
#include "glsl.h"
#include "warp.h"
#ifdef __cplusplus
namespace shared {
#endif

/// The bed's healing phase; wound::Phase.
struct BedPhase
{
    float clot, fibrin, granulation; // shares of the bed, 0..1
    float rim;                       // factor on the opacity outside the border
    float bed_luminance;             // median of the day-0 bed
};

/// The wound today, for wound_texture.comp.
struct WoundToday
{
    WarpHeader border;      // today's patch -> day 0, inside the outer border
    WarpHeader bed;         // today's patch -> day 0, for the open bed
    ivec2 first_texel;      // patch texel where the images begin; they hold only the region that is drawn
    float border_softness;  // 0: the border is sharp as in the photograph; 1: soft, as of new skin
    float bed_presence;     // 1 until closure, then fades to 0
    BedPhase phase;
};

/// Parameters of wound_relief.comp.
struct Relief
{
    float depth_scale;  // today's depth / day 0's
    float scar_mm;      // height of new skin between bed and border
    float texel_mm;     // width of a texel on the skin
    float reach_texels; // largest distance of occluders
    float bump_mm;      // height of the bed's bumps: the bed is so much higher where it is e times as light
    float bump_texels;  // half the distance over which their slope is measured: whole texels and a half
    float slope_limit;  // a slope s becomes s / (1 + slope_limit s)
};

#ifdef __cplusplus
} // namespace shared
#endif
#endif
