#include "base/segment.hpp"

#include <algorithm>

namespace base {

std::optional<Segment> clipped(const Segment& segment, const cv::Rect2d& rect)
{
    double enter = 0, leave = 1;
    const cv::Point2d from = segment.from, along = segment.to - segment.from;
    // Clips the interval [enter, leave] to the t with step * t <= room.
    const auto keep = [&](double step, double room) {
        if (step < 0)
            enter = std::max(enter, room / step);
        else if (step > 0)
            leave = std::min(leave, room / step);
        return step != 0 || room >= 0;
    };
    const bool inside = keep(-along.x, from.x - rect.x) && keep(along.x, rect.x + rect.width - from.x) &&
                        keep(-along.y, from.y - rect.y) && keep(along.y, rect.y + rect.height - from.y);
    if (!inside || enter > leave)
        return std::nullopt;
    return Segment{enter > 0 ? from + enter * along : from, leave < 1 ? from + leave * along : segment.to};
}

} // namespace base
