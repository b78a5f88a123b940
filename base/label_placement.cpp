#include "base/label_placement.hpp"

#include <algorithm>

namespace base {

bool LabelPlacement::is_free(const cv::Rect2d& rect) const
{
    return (rect & bounds_).area() >= rect.area() * (1 - 1e-9) &&
           std::ranges::none_of(taken_, [&](const cv::Rect2d& other) { return (rect & other).area() > 0; });
}

std::size_t LabelPlacement::covered(const cv::Rect2d& rect) const
{
    return std::size_t(std::ranges::count_if(
        avoided_, [&](const Segment& segment) { return clipped(segment, rect).has_value(); }));
}

std::optional<cv::Rect2d> LabelPlacement::place(const std::vector<cv::Rect2d>& candidates)
{
    std::optional<cv::Rect2d> best;
    std::size_t least = 0;
    for (const cv::Rect2d& candidate : candidates) {
        if (!is_free(candidate))
            continue;
        const std::size_t cost = covered(candidate);
        if (!best || cost < least) {
            best = candidate;
            least = cost;
        }
        if (least == 0)
            break;
    }
    if (best)
        taken_.push_back(*best);
    return best;
}

std::vector<cv::Rect2d> places_around(cv::Point2d point, double clearance, cv::Size2d size)
{
    constexpr int rings = 8;
    constexpr double ring_distance = 9; // px
    std::vector<cv::Rect2d> places;
    for (int ring = 0; ring < rings; ++ring) {
        const double off = clearance + ring * ring_distance;
        const double right = point.x + off, left = point.x - off - size.width,
                     middle = point.x - size.width / 2, above = point.y - off - size.height,
                     below = point.y + off, beside = point.y - size.height / 2;
        for (const cv::Point2d corner :
             {cv::Point2d(right, above + off / 2), cv::Point2d(right, below - off / 2),
              cv::Point2d(left, above + off / 2), cv::Point2d(left, below - off / 2),
              cv::Point2d(right, beside), cv::Point2d(left, beside), cv::Point2d(middle, above),
              cv::Point2d(middle, below)})
            places.emplace_back(corner, size);
    }
    return places;
}

} // namespace base
