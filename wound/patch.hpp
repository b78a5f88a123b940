// What goes in and what comes out of preparing a wound: a photograph, and the square maps made from it.
//
// Patch coordinates: the square patch is [-1,1] x [-1,1], x right, y down, 0 the patch's middle; texel (i,j)
// of an n x n map has its centre at ((i + .5) 2/n - 1, (j + .5) 2/n - 1). The wound's centroid is placed at
// the patch's middle.
#pragma once
#include <opencv2/core.hpp>

namespace wound {

struct Photograph
{
    cv::Mat3b srgb;         // RGB order
    cv::Mat1b mask;         // 255 in the wound; empty: segment
    cv::Mat1b other_wounds; // 255 in what is prepared as a wound of its own; empty: none
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
    /// Healthy skin, beside the wound. If not, prepare() has put average_skin there (wound/healthy_skin.hpp).
    bool shows_skin = true;
};

} // namespace wound
