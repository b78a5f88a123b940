// Where in a photograph wounds may be, when nobody says: closed regions redder and darker than the skin
// around them.
#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace wound {

struct WoundCandidate
{
    cv::Mat1b region;  // 255 inside, holes filled; of the picture's size
    cv::Rect bounds;   // of the region
    cv::Point deepest; // of its pixels the farthest from its border
    double score = 0;  // the more the likelier
};

/// No two overlap; the likeliest first. `lab`: CIELAB of a photograph of some 400 pixels a side; `picture`:
/// 255 where it shows anything.
std::vector<WoundCandidate> wound_candidates(const cv::Mat3f& lab, const cv::Mat1b& picture,
                                             std::optional<cv::Point> seed = {});

} // namespace wound
