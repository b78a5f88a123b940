// Where the generated wound's open bed is: a ragged outline and the distance to it.
#pragma once
#include "wound/synthetic/noise.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace wound {

/// Where pixel (x, y) of a picture `size` pixels wide lies, mm from the picture's middle.
inline cv::Point2f synthetic_position_mm(float x, float y, int size)
{
    const float mm_per_px = float(synthetic_width_mm) / float(size);
    return cv::Point2f(x + .5f, y + .5f) * mm_per_px - cv::Point2f(1, 1) * float(synthetic_width_mm / 2);
}

/// Signed distance to the outline for every pixel, mm, positive inside. One connected region without holes.
cv::Mat1f outline_distance(const SyntheticWound& wound, const Noise& noise);

} // namespace wound
