// A wound as data: the part prepared once from a photograph, and its state on a given day.
//
//   Photograph -> prepare() -> PreparedWound -> match_to_skin() -> wound_at(day) -> WoundDay
// Patch coordinates are defined in wound/patch.hpp.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "wound/healing/healing.hpp"
#include "wound/healing/phases.hpp"
#include "wound/healing/scar.hpp"
#include "wound/patch.hpp"
#include "wound/warp/warp.hpp"

namespace wound {

struct PreparedWound
{
    Patch patch;
    std::vector<cv::Point2d> border; // closed polyline, patch coordinates, counter-clockwise seen on screen
    std::vector<cv::Point2d> control_points; // on the border, patch coordinates
    cv::Point2d centroid;                    // patch coordinates (0,0 up to rounding)
    double area = 0;                         // of the mask, patch units squared (the patch is 4)
    ContractionFlow flow;                    // what the warps of all days share
    cv::Mat1b photo_mask;     // 255 in the wound, of the photograph's size; empty for a patch made elsewhere
    cv::Point2d photo_center; // pixel coordinates of the patch's middle in the photograph
    double photo_side = 0;    // pixels, of the patch's square in the photograph
};

/// One day. r is the unhealed ratio, 1 -> 0; recovery = 1 - r (PAPER.md 1 keeps the two apart).
struct WoundDay
{
    double day = 0;
    double unhealed_ratio = 1; // area of the open bed / initial area
    double border_ratio =
        1; // area inside the outer border / initial area; equals unhealed_ratio for pure contraction
    double recovery_ratio = 0;  // 1 - unhealed_ratio, clamped to 0..1
    double bed_recovery = 0;    // r of eq. (4) in the open bed
    double border_recovery = 0; // r of eq. (4) on new epithelium and in the rim
    double border_softness = 0; // 0 the photograph's border .. 1 the soft border of new skin
    double depth_scale = 1;     // sqrt(unhealed_ratio), at most 1
    bool in_phases = false;     // whether `phase` changes the bed's colour, in addition to eq. (4)
    Phase phase;
    double bed_presence =
        1;          // opacity of the bed: 1 until closure, then falls to 0 when the bed is one texel wide
    ScarState scar; // appearance of the skin inside the border and outside the bed
    Warp border_warp, bed_warp; // backward maps: today's patch coordinates -> day 0's
};

} // namespace wound
