// Estimates a wound's depth from the skin layer that its hue shows and the layers' thickness at its place on
// the face. Lee, Lee, Chin 2011, "Multi-layer structural wound synthesis on 3D face" (hue -> layer); Choi &
// Chin 2014, Table 1 and Fig. 5.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "wound/optics/skin_presets.hpp"
#include "wound/patch.hpp"

namespace wound {

/// Thickness of the layers, mm. The defaults are a cheek.
struct TissueThickness
{
    double epidermis = .2; // Choi & Chin 2014, Table 1
    double dermis = 1.5;
    double subcutis = 9;
    bool operator==(const TissueThickness&) const = default;
};

/// Thickness at a place in face coordinates: x from -1 (the right ear, left in a portrait) over 0 (the
/// midline) to 1, y from -1 (the chin's underside) over 0 (the tip of the nose) to 1 (the hairline). Smooth
/// interpolation of the sites in depth.cpp, symmetric about the midline.
TissueThickness tissue_thickness(cv::Point2d face);

/// The tissue at a place: facial tissue (Table 1) gets the place's thicknesses, within the ranges of the
/// table's row d: epidermis .2, dermis 1..4, subcutis 4..9 mm. Other tissue is returned as it is.
optics::HealingTissue at_place(optics::HealingTissue tissue, const TissueThickness& thickness);

/// The layer that a pixel's hue shows, continuous: 0..1 within the epidermis, 1..2 within the dermis, 2..3
/// within the subcutis. `skin` is the mean colour of the photograph's healthy skin; both are CIELAB.
double layer_reached(const cv::Vec3f& lab, const cv::Vec3f& skin);

struct DepthOptions
{
    TissueThickness tissue;
    double rim_swelling_mm = .3; // height of the swollen rim just outside the border
};

/// Depth of missing tissue in mm, of the size of `mask`: smooth floor, walls inside the border that
/// slope over about 1.5 times their height, unevenly, a swollen rim (negative) outside it and 0 farther away.
/// `color` is linear RGB, `mask` coverage 0..1; both are `width_mm` wide.
cv::Mat1f depth_map(const cv::Mat3f& color, const cv::Mat1f& mask, double width_mm,
                    const DepthOptions& options);

/// The same of known layers (Photograph::layer).
cv::Mat1f depth_of_layers(const cv::Mat1f& layer, const TissueThickness& tissue);

/// Depth of a patch: of its layers where they are known, else judged from its colour by depth_map().
cv::Mat1f depth_of(const Patch& patch, const DepthOptions& options);

/// Depth in mm along the horizontal line through `at` (patch coordinates), one value per texel; as in the
/// paper's Figure 5.
std::vector<double> depth_profile(const cv::Mat1f& depth_mm, cv::Point2d at);

} // namespace wound
