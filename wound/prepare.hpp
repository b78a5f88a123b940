// Computes a wound's data from a photograph, once, and from those its state on any day (wound/wound.hpp).
#pragma once
#include <string>
#include <vector>

#include "wound/depth.hpp"
#include "wound/photo/segmentation.hpp"
#include "wound/wound.hpp"

namespace wound {

inline constexpr double wound_share = .45; // the wound's longer side / the patch's side
inline constexpr double least_width_mm = .5;

/// Texels a side of a patch, by the width of its wound, mm, where many wounds share memory and time: no texel
/// is wider than the default wound's with 512.
int shared_patch_size(double width_mm);

struct Preparation
{
    std::string where = "photograph"; // names the photograph in error messages
    double width_mm = 30;             // of the wound's longer side, on the head; 0.5..200
    int patch_size = 512;             // texels a side
    SegmentationHints hints;          // used if the photograph has no mask
    double control_spacing = 0;       // of control_points(), patch units; 0: spacing_from_curvature()
    DepthOptions depth;
};

/// Segments (or checks the given mask), takes the largest wound, resamples a square patch around the centroid
/// and measures border, control points, depth and the contraction's flow in it. The colour is the
/// photograph's own; match_to_skin() fits it to a face. Throws base::InputError.
PreparedWound prepare(const Photograph& photograph, const Preparation& preparation);

/// One of the wounds of a photograph, and its position there.
struct WoundPart
{
    Photograph photograph; // mask: this wound alone
    double width_mm = 30;
    cv::Point2d offset_mm; // from the largest wound's centroid to this one's; x right, y down
};

/// The wounds of a photograph, the largest first, each with its mask: the components of the photograph's mask
/// or of segment()'s. preparation.width_mm is that of the largest wound and sets the scale of all. Throws
/// base::InputError as checked_mask() and segment() do, and for more than 64 components.
std::vector<WoundPart> separate(const Photograph& photograph, const Preparation& preparation);

/// Every wound of a photograph, prepared.
std::vector<PreparedWound> prepare_all(const Photograph& photograph, const Preparation& preparation);

/// Prepares a patch made elsewhere, whose color, mask and width_mm (and depth_mm if `keep_depth`) are filled.
PreparedWound prepare_patch(Patch patch, const Preparation& preparation, bool keep_depth);

/// The wound's state on a day: ratios, phase, scar and both backward warps.
WoundDay wound_at(const PreparedWound& wound, const Healing& healing, double day,
                  WarpModel model = WarpModel::Grid);

} // namespace wound
