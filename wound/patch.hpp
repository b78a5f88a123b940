// The input and output of prepare(): a photograph, and the square maps made from it.
//
// Patch coordinates: the square patch is [-1,1] x [-1,1], x right, y down; texel (i,j) of an n x n map has
// its centre at ((i + .5) 2/n - 1, (j + .5) 2/n - 1). The wound's centroid is at the patch's middle, (0,0).
#pragma once
#include <opencv2/core.hpp>

namespace wound {

struct Photograph
{
    cv::Mat3b srgb;         // RGB order
    cv::Mat1b mask;         // 255 in the wound; empty: to be segmented
    cv::Mat1b other_wounds; // 255 in wounds that are prepared separately; empty: none
    /// The layer of the skin that is open, as layer_reached(); negative: raised by that many thicknesses of
    /// the dermis. Known for generated wounds; empty: judged from the colour.
    cv::Mat1f layer;
};

/// The wound at day 0 as square maps of equal size (default 512 x 512) over `width_mm` of skin.
struct Patch
{
    cv::Mat3f color; // linear Rec. 709 reflectance 0..1
    cv::Mat1f
        opacity;    // 0 the face's own skin .. 1 the patch's colour; reaches 0 well inside the patch's edge
    cv::Mat1f mask; // antialiased coverage of the wound 0..1
    cv::Mat1f depth_mm;  // tissue missing; negative where the rim is swollen
    double width_mm = 0; // of the whole patch, on the head
    /// Whether it shows healthy skin; if not, prepare() uses average_skin (wound/photo/healthy_skin.hpp).
    bool shows_skin = true;
    cv::Mat1f layer; // Photograph::layer; may be empty
};

} // namespace wound
