// Mirror images of lamps in a photograph, which would not follow the renderer's light.
#pragma once
#include <opencv2/core.hpp>

namespace wound {

/// Replaces most of each bright, colourless spot by the colour around it. In the wound (`coverage` 0..1)
/// spots up to .6 `radius` wide count, since little there is white; outside, where dead skin and scales are,
/// only those that are nearly burnt out. `color` is linear, 0..1 and above 0; `radius` is of the circle of
/// the wound's area, pixels.
void flatten_glints(cv::Mat3f& color, const cv::Mat1f& coverage, float radius);

} // namespace wound
