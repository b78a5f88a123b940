// The FLIP difference of two pictures: what a viewer sees who alternates between them. P. Andersson et al.
// 2020, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2).
#pragma once
#include <numbers>
#include <opencv2/core.hpp>

namespace base {

/// Pixels in one degree of visual angle at the middle of a screen `width_m` metres and `width_px` pixels
/// wide, seen from `distance_m` metres.
constexpr double pixels_per_degree(double distance_m, double width_px, double width_m)
{
    return distance_m * width_px / width_m * std::numbers::pi / 180;
}

/// The paper's viewer, 0.7 m before a 4K screen 0.7 m wide: about 67.
inline constexpr double usual_pixels_per_degree = pixels_per_degree(0.7, 3840, 0.7);

/// LDR-FLIP of two 8-bit sRGB pictures, RGB order, of the same size and not empty: per pixel 0 (no visible
/// difference) to 1; the mean is the value for the picture. Symmetric in both pictures.
/// `pixels_per_degree` at least 1.
cv::Mat1f flip(const cv::Mat3b& reference, const cv::Mat3b& test,
               double pixels_per_degree = usual_pixels_per_degree);

} // namespace base
