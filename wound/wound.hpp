// A wound from photograph to any day: what is prepared once, and what it is on a given day. Plain C++, double
// precision.
//
//   Photograph -> prepare() -> PreparedWound -> match_to_skin() -> wound_at(day) -> WoundDay
//
// Patch coordinates: the square patch is [-1,1] x [-1,1], x right, y down, 0 the patch's middle; texel (i,j)
// of an n x n map has its centre at ((i + .5) 2/n - 1, (j + .5) 2/n - 1). The wound's centroid is placed at
// the patch's middle.
#pragma once
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "wound/healing.hpp"
#include "wound/scar.hpp"
#include "wound/warp.hpp"

namespace wound {

struct Photograph
{
    cv::Mat3b srgb; // RGB order
    cv::Mat1b mask; // 255 in the wound; empty: segment
};

/// The wound at day 0 as square maps of equal size (default 512 x 512) over `width_mm` of skin.
struct Patch
{
    cv::Mat3f color; // linear Rec. 709 reflectance 0..1
    cv::Mat1f
        opacity;    // 0 the face's own skin .. 1 the patch's colour; falls to 0 well inside the patch's edge
    cv::Mat1f mask; // antialiased coverage of the wound (inside its border) 0..1
    cv::Mat1f depth_mm;  // tissue missing; negative where the rim is swollen
    double width_mm = 0; // of the whole patch, on the head
};

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
    double recovery_ratio = 0; // 1 - unhealed_ratio, clamped to 0..1
    double depth_scale = 1;    // sqrt(unhealed_ratio), at most 1
    double bed_presence =
        1;          // 1 until closure, then 0 by the time the bed is a texel wide: the last of it fades
    ScarState scar; // the look of what is inside the border and outside the bed
    Warp border_warp, bed_warp; // backward maps: today's patch coordinates -> day 0's
};

} // namespace wound
