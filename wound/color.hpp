// Colour as numbers: linear Rec. 709 light, its sRGB encoding, CIELAB under D65 and the CIEDE2000 difference.
#pragma once
#include <opencv2/core.hpp>

namespace wound {

using Color = cv::Vec3d; // linear Rec. 709 (sRGB primaries, D65 white); 1 = diffuse white

/// IEC 61966-2-1, exact piecewise form, one channel. Below 0 the straight part goes on; above 1 the power
/// does.
double srgb_from_linear(double linear);
double linear_from_srgb(double encoded);

Color linear_from_srgb8(const cv::Vec3b& rgb);
/// Rounded to nearest; values outside 0..1 are clamped, NaN is black.
cv::Vec3b srgb8_from_linear(const Color& linear);

/// CIELAB (CIE 15) relative to the D65 white that linear (1,1,1) has.
struct Lab
{
    double l = 0, a = 0, b = 0;
};
Lab lab_from_linear(const Color& linear);
Color linear_from_lab(const Lab& lab);

/// CIEDE2000 (CIE 142-2001) with kL = kC = kH = 1, after Sharma, Wu & Dalal 2005. About 1 is just noticeable.
double delta_e2000(const Lab& x, const Lab& y);

} // namespace wound
