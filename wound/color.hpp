// Colour spaces: sRGB (IEC 61966-2-1), linear Rec. 709, CIELAB (D65).
#pragma once
#include <opencv2/core.hpp>

namespace wound {

/// 8-bit sRGB to linear 0..1, channel by channel.
cv::Mat3f linear_from_srgb(const cv::Mat3b& srgb);
/// Linear, clamped to 0..1, to 8-bit sRGB.
cv::Mat3b srgb_from_linear(const cv::Mat3f& linear);
/// L 0..100, a and b about -100..100, from linear values clamped to 0..1.
cv::Mat3f lab_from_linear(const cv::Mat3f& linear);

} // namespace wound
