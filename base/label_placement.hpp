// Finds places for labels, so that none covers another one or a point, and few cover a line.
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
    /// A line or, with both ends in one place, a point that a label covers when there is no better place.
    void rather_not_cover(const Segment& segment) { avoided_.push_back(segment); }

    /// The candidate that covers least, the first of equals; it is taken from then on. None when each of them
    /// covers what must not be covered.
    std::optional<cv::Rect2d> place(const std::vector<cv::Rect2d>& candidates);

  private:
    bool is_free(const cv::Rect2d& rect) const;
    std::size_t covered(const cv::Rect2d& rect) const;

    cv::Rect2d bounds_;
    std::vector<cv::Rect2d> taken_;
    std::vector<Segment> avoided_;
};

/// Places beside a point, the nearest first: at `clearance` pixels, then farther away.
std::vector<cv::Rect2d> places_around(cv::Point2d point, double clearance, cv::Size2d size);

} // namespace base
