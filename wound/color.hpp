// Colour spaces: sRGB (IEC 61966-2-1), linear Rec. 709, CIELAB (D65).
#pragma once
#include <cmath>
#include <opencv2/core.hpp>

namespace wound {

/// Component 0..1, sRGB code to linear.
inline float srgb_to_linear(float code)
{
    return code <= .04045f ? code / 12.92f : std::pow((code + .055f) / 1.055f, 2.4f);
}

/// Component 0..1, linear to sRGB code.
inline float linear_to_srgb(float linear)
{
    return linear <= .0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - .055f;
}

/// Relative luminance of linear Rec. 709 components.
template <class Rgb>
float luminance(const Rgb& linear)
{
    return .2126f * linear[0] + .7152f * linear[1] + .0722f * linear[2];
}

/// 8-bit sRGB to linear 0..1, channel by channel.
cv::Mat3f linear_from_srgb(const cv::Mat3b& srgb);
/// Linear, clamped to 0..1, to 8-bit sRGB.
cv::Mat3b srgb_from_linear(const cv::Mat3f& linear);
/// L 0..100, a and b about -100..100, from linear values clamped to 0..1.
cv::Mat3f lab_from_linear(const cv::Mat3f& linear);

} // namespace wound
