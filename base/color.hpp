// Colour conversions: linear Rec. 709, sRGB encoding, CIELAB under D65 and the CIEDE2000 difference.
#pragma once
#include <cmath>
#include <opencv2/core.hpp>

namespace base {

using Color = cv::Vec3d; // linear Rec. 709 (sRGB primaries, D65 white); 1 = diffuse white

/// IEC 61966-2-1, exact piecewise form, one channel. The linear part extends below 0, the power above 1.
double srgb_from_linear(double linear);
double linear_from_srgb(double encoded);

/// Single-precision versions for loops over pixels.
inline float srgb_to_linear(float code)
{
    return code <= .04045f ? code / 12.92f : std::pow((code + .055f) / 1.055f, 2.4f);
}
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

Color linear_from_srgb8(const cv::Vec3b& rgb);
/// Rounded to nearest; values outside 0..1 are clamped, NaN becomes 0.
cv::Vec3b srgb8_from_linear(const Color& linear);

/// Linear Rec. 709 to CIE XYZ divided by that of D65 white: (1,1,1) stays (1,1,1).
cv::Matx33d relative_xyz_from_linear();

/// CIELAB (CIE 15) relative to D65 white, which is linear (1,1,1).
struct Lab
{
    double l = 0, a = 0, b = 0;
};
Lab lab_from_linear(const Color& linear);
Color linear_from_lab(const Lab& lab);

/// CIEDE2000 (CIE 142-2001), kL = kC = kH = 1, after Sharma, Wu & Dalal 2005. About 1 is just noticeable.
double delta_e2000(const Lab& x, const Lab& y);

// ---- Whole pictures -------------------------------------------------------------------------------------

/// 8-bit sRGB to linear 0..1.
cv::Mat3f linear_from_srgb(const cv::Mat3b& srgb);
/// Linear, clamped to 0..1, to 8-bit sRGB.
cv::Mat3b srgb_from_linear(const cv::Mat3f& linear);
/// L 0..100, a and b about -100..100, from linear values clamped to 0..1.
cv::Mat3f lab_from_linear(const cv::Mat3f& linear);

} // namespace base
