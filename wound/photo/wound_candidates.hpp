// Finds wound candidates in a photograph: closed regions redder and darker than the skin around them.
#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace wound {

struct WoundCandidate
{
    cv::Mat1b region;  // 255 inside, holes filled; of the picture's size
    cv::Rect bounds;   // of the region
    cv::Point deepest; // the region's pixel farthest from its border
    double score = 0;  // higher is likelier
};

/// Candidates without overlap, the likeliest first; with a seed, only those that contain it. `lab`: CIELAB of
/// a photograph of about 400 pixels a side; `picture`: picture_area().
std::vector<WoundCandidate> wound_candidates(const cv::Mat3f& lab, const cv::Mat1b& picture,
                                             std::optional<cv::Point> seed = {});

} // namespace wound
