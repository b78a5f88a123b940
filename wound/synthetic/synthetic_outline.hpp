// The outline of the generated wound's open bed: ragged, given by the signed distance to it.
#pragma once
#include "wound/synthetic/kind.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace wound {

/// Position of pixel (x, y) in a picture `size` pixels wide, in mm from the picture's middle.
inline cv::Point2f synthetic_position_mm(float x, float y, int size)
{
    const float mm_per_px = float(synthetic_width_mm) / float(size);
    return cv::Point2f(x + .5f, y + .5f) * mm_per_px - cv::Point2f(1, 1) * float(synthetic_width_mm / 2);
}

/// Signed distance to the outline for every pixel, mm, positive inside. One connected region without holes.
cv::Mat1f outline_distance(const WoundKind& kind, const SyntheticWound& wound, const Noise& noise);

} // namespace wound
