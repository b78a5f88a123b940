// Cuts one wound out of its surroundings at working resolution: what is likely wound by its colour, or a
// guess at its region, refined by GrabCut (Rother, Kolmogorov, Blake 2004).
#pragma once
#include <opencv2/core.hpp>

namespace wound {

/// A part of a photograph in which one wound is looked for. All maps are of the same size.
struct CutProblem
{
    cv::Rect frame; // of the photograph, its pixels
    cv::Mat3b srgb;
    cv::Mat3f lab;     // CIELAB of srgb
    cv::Mat1b picture; // 255 where there is a picture
    cv::Rect rect;     // the wound lies inside
    cv::Point seed;    // inside the wound
    cv::Mat1b guess;   // 255 where the wound is thought to be; empty: told by the colours near the seed
};

/// `rect` and half as much again on each side, at most `working_size` pixels on the longer side.
CutProblem pose(const cv::Mat3b& srgb, const cv::Rect& rect, cv::Point seed, int working_size);

/// 255 in the wound: one component without holes, or none. Deterministic.
cv::Mat1b solve(const CutProblem& problem);

/// How wound and skin differ across the mask's border, CIELAB units, averaged along it. A border that is the
/// rectangle's own counts as none.
struct BorderContrast
{
    double distance = 0;   // of the colours just inside and just outside
    double wound_like = 0; // how much redder and darker the inside is; a limb before a dark background is not
};
BorderContrast border_contrast(const CutProblem& problem, const cv::Mat1b& mask);

} // namespace wound
