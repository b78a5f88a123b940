// Finds positions for labels that overlap neither each other nor reserved rectangles and cover few lines.
#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/segment.hpp"

namespace base {

class LabelPlacement
{
  public:
    /// Labels lie inside `bounds`.
    explicit LabelPlacement(const cv::Rect2d& bounds) : bounds_(bounds) {}

    void never_cover(const cv::Rect2d& rect) { taken_.push_back(rect); }
    /// A line (or a point, if both ends are equal) that a label covers only when no better place is free.
    void rather_not_cover(const Segment& segment) { avoided_.push_back(segment); }

    /// Chooses the free candidate that covers the fewest segments, the first of equals, and reserves it. None
    /// when no candidate is free.
    std::optional<cv::Rect2d> place(const std::vector<cv::Rect2d>& candidates);

  private:
    bool is_free(const cv::Rect2d& rect) const;
    std::size_t covered(const cv::Rect2d& rect) const;

    cv::Rect2d bounds_;
    std::vector<cv::Rect2d> taken_;
    std::vector<Segment> avoided_;
};

/// Rectangles of `size` around a point, nearest first, starting `clearance` pixels away.
std::vector<cv::Rect2d> places_around(cv::Point2d point, double clearance, cv::Size2d size);

} // namespace base
