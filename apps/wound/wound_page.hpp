// The output of `cicatrix wound PHOTO`: a page like the paper's Figures 1, 4 and 5, and its numbers as JSON.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>

#include "wound/wound.hpp"

namespace wound_command {

/// The page, RGB: mask, centroid and control points with their displacements; the warped and the plainly
/// scaled wound at several ratios; the warped grid; depth map and profiles; ratios over days.
cv::Mat3b draw_wound_page(const wound::Photograph& photograph, const wound::PreparedWound& wound,
                          const wound::Healing& healing);

/// The content of wound.json: all numbers of the page; names that end in _px: pixels of the photograph.
nlohmann::json wound_to_json(const wound::PreparedWound& wound, const wound::Healing& healing);

} // namespace wound_command
