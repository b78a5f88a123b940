// Parameters of the wound's two compute passes; the same bytes in C++ and GLSL (scalar layout).
#ifndef SHARED_WOUND_H
#define SHARED_WOUND_H
#include "glsl.h"
#include "warp.h"
#ifdef __cplusplus
namespace shared {
#endif

/// What has become of the bed since the photograph; wound::Phase.
struct BedPhase
{
    float clot, fibrin, granulation; // shares of the bed, 0..1
    float rim;                       // factor on the opacity outside the border
    float bed_luminance;             // median of the day-0 bed
};

/// The wound today, for wound_texture.comp.
struct WoundToday
{
    WarpHeader border;      // today's patch -> day 0, for what lies inside the outer border
    WarpHeader bed;         // the same for the open bed
    ivec2 first_texel;      // of the patch, where the images begin: they hold only what is ever drawn
    float border_softness;  // 0 the border is the photograph's, 1 that of new skin, which ends softly
    float bed_presence;     // 1 until closure, then 0: the last of the bed fades
    BedPhase phase;
};

/// For wound_relief.comp.
struct Relief
{
    float depth_scale;  // today's depth / day 0's
    float scar_mm;      // height of new skin between the bed and the border
    float texel_mm;     // width of a texel on the skin
    float reach_texels; // how far occlusion looks
};

#ifdef __cplusplus
} // namespace shared
#endif
#endif
