// Segments one wound at working resolution: pixels of likely colour, or a guess of the region, are refined by
// GrabCut (Rother, Kolmogorov, Blake 2004).
#pragma once
#include <opencv2/core.hpp>

namespace wound {

/// The part of a photograph in which one wound is segmented. All maps have the same size.
struct CutProblem
{
    cv::Rect frame; // this part, in pixels of the photograph
    cv::Mat3b srgb;
    cv::Mat3f lab;     // CIELAB of srgb
    cv::Mat1b picture; // 255 where there is a picture, see picture_area()
    cv::Rect rect;     // contains the wound; pixels of the maps
    cv::Point seed;    // inside the wound; pixels of the maps
    cv::Mat1b guess;   // 255 in the assumed wound; empty: estimated from the colours near the seed
};

/// Maps of `rect` enlarged by half its size on each side, at most `working_size` pixels on the longer side.
CutProblem pose(const cv::Mat3b& srgb, const cv::Rect& rect, cv::Point seed, int working_size);

/// 255 in the wound: one component without holes, or none. Deterministic.
cv::Mat1b solve(const CutProblem& problem);

/// Colour contrast across the mask's border, CIELAB units, averaged along it. Border points on the rectangle
/// count as 0.
struct BorderContrast
{
    double distance = 0;   // between the colours just inside and just outside
    double wound_like = 0; // how much redder and darker the inside is; 0 for a limb before a dark background
};
BorderContrast border_contrast(const CutProblem& problem, const cv::Mat1b& mask);

} // namespace wound
