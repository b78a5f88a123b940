// Clips a line segment to a rectangle.
#pragma once
#include <opencv2/core.hpp>
#include <optional>

namespace base {

struct Segment
{
    cv::Point2d from, to;
};

/// Liang & Barsky 1984, "A new concept and method for line clipping". None when the segment lies outside. A
/// segment of zero length is a point. The rectangle's border counts as inside.
std::optional<Segment> clipped(const Segment& segment, const cv::Rect2d& rect);

} // namespace base
