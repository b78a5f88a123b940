// From a photograph to everything that is computed once per wound, and from there to any day
// (wound/wound.hpp).
#pragma once
#include <string>
#include <vector>

#include "wound/depth.hpp"
#include "wound/photo/segmentation.hpp"
#include "wound/wound.hpp"

namespace wound {

inline constexpr double wound_share = .45; // the wound's longer side / the patch's side
inline constexpr double least_width_mm = .5;

struct Preparation
{
    std::string where = "photograph"; // names the photograph in error messages
    double width_mm = 30;             // of the wound's longer side, on the head; 0.5..200
    int patch_size = 512;             // texels a side
    SegmentationHints hints;          // when the photograph has no mask
    double control_spacing =
        0; // of the lines that give control points, patch units; 0: from the border's curvature
    DepthOptions depth;
};

/// Segments (or checks the given mask), takes the largest wound, resamples a square patch around the centroid
/// and measures border, control points, depth and the contraction's flow in it. The colour is the
/// photograph's own; match_to_skin() fits it to a face. Throws base::InputError.
PreparedWound prepare(const Photograph& photograph, const Preparation& preparation);

/// One of the wounds of a photograph, and how it lies there.
struct WoundPart
{
    Photograph photograph; // mask: this wound alone
    double width_mm = 30;
    cv::Point2d offset_mm; // of its centroid from the largest one's; x right, y down
};

/// The wounds of a photograph, the largest first, each with its mask: the components of the given one, or of
/// what segment() finds. All are at the scale that `preparation.width_mm`, the largest one's, gives. Throws
/// base::InputError for a mask that checked_mask() refuses or of more than 64 components, and as
/// segment() does.
std::vector<WoundPart> separate(const Photograph& photograph, const Preparation& preparation);

/// Every wound of a photograph, prepared.
std::vector<PreparedWound> prepare_all(const Photograph& photograph, const Preparation& preparation);

/// The same for a patch made elsewhere: color, mask and width_mm are filled; depth too when `keep_depth`.
PreparedWound prepare_patch(Patch patch, const Preparation& preparation, bool keep_depth);

/// What the wound is on a day: ratios and both backward warps.
WoundDay wound_at(const PreparedWound& wound, const Healing& healing, double day,
                  WarpModel model = WarpModel::Grid);

} // namespace wound
