// From linear light to what a picture's file holds, in double precision: the twin of shaders/tonemap.comp and
// shaders/lib/color.glsl. A test compares the two.
#pragma once
#include <opencv2/core.hpp>

#include "base/color.hpp"

namespace base {

/// Identity up to .8, then towards 1 without reaching it, channel by channel.
Color soft_shoulder(const Color& linear);

/// The studio's backdrop, a vertical gradient: linear, not exposed, at the top and the bottom of the picture.
inline constexpr float backdrop_top[3] = {0.045f, 0.05f, 0.058f}, backdrop_bottom[3] = {0.17f, 0.18f, 0.195f};

/// Linear light, premultiplied by its alpha, exposed and on the backdrop; `height` 0 top .. 1 bottom. Values
/// above 1 are still to be clipped.
Color on_backdrop(const Color& radiance, double alpha, double exposure_stops, double height);

/// The colour of that, clipped to what a picture holds.
Lab shown_lab(const Color& radiance, double alpha, double exposure_stops, double height);

/// A picture of premultiplied radiance (RGBA), as sRGB.
cv::Mat3b encode_picture(const cv::Mat4f& radiance, double exposure_stops);

} // namespace base
