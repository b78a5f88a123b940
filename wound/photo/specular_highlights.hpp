// Removes specular highlights from a photograph, because they would not follow the renderer's lights.
#pragma once
#include <opencv2/core.hpp>

namespace wound {

/// Replaces most of each bright, colourless spot up to .6 `radius` wide by the colour around it. Outside the
/// wound (`coverage` 0..1) only nearly saturated spots count, because dead skin and scales are white there.
/// `color` is linear, above 0 and at most 1; `radius` in pixels is that of the circle of the wound's area.
void remove_highlights(cv::Mat3f& color, const cv::Mat1f& coverage, float radius);

} // namespace wound
