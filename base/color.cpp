#include "base/color.hpp"

#include <cmath>
#include <numbers>

namespace base {
namespace {

// IEC 61966-2-1: linear Rec. 709 -> XYZ, white at Y = 1.
const cv::Matx33d xyz_from_linear(0.4124564, 0.3575761, 0.1804375, //
                                  0.2126729, 0.7151522, 0.0721750, //
                                  0.0193339, 0.1191920, 0.9503041);
const cv::Matx33d linear_from_xyz = xyz_from_linear.inv();
// White is the vector of the matrix's row sums, so that (1,1,1) is exactly neutral.
const cv::Vec3d white = xyz_from_linear * cv::Vec3d(1, 1, 1);

constexpr double lab_knee = 6.0 / 29.0;

double lab_root(double t)
{
    return t > lab_knee * lab_knee * lab_knee ? std::cbrt(t) : t / (3 * lab_knee * lab_knee) + 4.0 / 29.0;
}

double lab_unroot(double f)
{
    return f > lab_knee ? f * f * f : 3 * lab_knee * lab_knee * (f - 4.0 / 29.0);
}

double square(double x)
{
    return x * x;
}

double seventh(double x)
{
    return std::pow(x, 7);
}

double degrees(double radians)
{
    return radians * 180 / std::numbers::pi;
}

double radians(double degrees_)
{
    return degrees_ * std::numbers::pi / 180;
}

// Hue angle in degrees, 0..360; a colour without chroma has hue 0 by definition (Sharma et al. eq. 7).
double hue_deg(double a, double b)
{
    if (a == 0 && b == 0)
        return 0;
    const double h = degrees(std::atan2(b, a));
    return h < 0 ? h + 360 : h;
}

} // namespace

double srgb_from_linear(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Color linear_from_srgb8(const cv::Vec3b& rgb)
{
    return {linear_from_srgb(rgb[0] / 255.0), linear_from_srgb(rgb[1] / 255.0),
            linear_from_srgb(rgb[2] / 255.0)};
}

cv::Vec3b srgb8_from_linear(const Color& linear)
{
    cv::Vec3b result;
    for (int i = 0; i < 3; ++i) {
        const double inside = std::fmin(std::fmax(linear[i], 0.0), 1.0); // fmax turns NaN into 0
        result[i] = static_cast<uchar>(std::lround(255 * srgb_from_linear(inside)));
    }
    return result;
}

cv::Matx33d relative_xyz_from_linear()
{
    return cv::Matx33d::diag({1 / white[0], 1 / white[1], 1 / white[2]}) * xyz_from_linear;
}

Lab lab_from_linear(const Color& linear)
{
    const cv::Vec3d xyz = xyz_from_linear * linear;
    const double x = lab_root(xyz[0] / white[0]);
    const double y = lab_root(xyz[1] / white[1]);
    const double z = lab_root(xyz[2] / white[2]);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Color linear_from_lab(const Lab& lab)
{
    const double y = (lab.l + 16) / 116;
    return linear_from_xyz * cv::Vec3d(white[0] * lab_unroot(y + lab.a / 500), white[1] * lab_unroot(y),
                                       white[2] * lab_unroot(y - lab.b / 200));
}

// G. Sharma, W. Wu, E. Dalal 2005, "The CIEDE2000 color-difference formula: implementation notes,
// supplementary test data, and mathematical observations", Color Research and Application 30(1). The
// equation numbers are those of the paper.
double delta_e2000(const Lab& x, const Lab& y)
{
    const double pow25 = seventh(25);
    const double mean_chroma = (std::hypot(x.a, x.b) + std::hypot(y.a, y.b)) / 2;
    const double g = 0.5 * (1 - std::sqrt(seventh(mean_chroma) / (seventh(mean_chroma) + pow25))); // (4)
    const double a1 = (1 + g) * x.a, a2 = (1 + g) * y.a;                                           // (5)
    const double c1 = std::hypot(a1, x.b), c2 = std::hypot(a2, y.b);                               // (6)
    const double h1 = hue_deg(a1, x.b), h2 = hue_deg(a2, y.b);                                     // (7)

    const bool gray = c1 * c2 == 0;
    double hue_step = gray ? 0 : h2 - h1; // (10)
    if (hue_step > 180)
        hue_step -= 360;
    else if (hue_step < -180)
        hue_step += 360;
    const double dl = y.l - x.l, dc = c2 - c1;
    const double dh = 2 * std::sqrt(c1 * c2) * std::sin(radians(hue_step / 2)); // (11)

    const double l = (x.l + y.l) / 2, c = (c1 + c2) / 2;
    double h = h1 + h2; // (14)
    if (!gray) {
        if (std::abs(h1 - h2) > 180)
            h += h < 360 ? 360 : -360;
        h /= 2;
    }
    const double t = 1 - 0.17 * std::cos(radians(h - 30)) + 0.24 * std::cos(radians(2 * h)) +
                     0.32 * std::cos(radians(3 * h + 6)) - 0.20 * std::cos(radians(4 * h - 63)); // (15)
    const double turn = 30 * std::exp(-square((h - 275) / 25));                                  // (16)
    const double rc = 2 * std::sqrt(seventh(c) / (seventh(c) + pow25));                          // (17)
    const double sl = 1 + 0.015 * square(l - 50) / std::sqrt(20 + square(l - 50));               // (18)
    const double sc = 1 + 0.045 * c;                                                             // (19)
    const double sh = 1 + 0.015 * c * t;                                                         // (20)
    const double rt = -std::sin(radians(2 * turn)) * rc;                                         // (21)
    return std::sqrt(square(dl / sl) + square(dc / sc) + square(dh / sh) +
                     rt * (dc / sc) * (dh / sh)); // (22)
}

} // namespace base
