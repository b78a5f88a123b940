// `cicatrix wound PHOTO`: one page, like the paper's Figures 1, 4 and 5, that shows what was made of a
// photograph, and its numbers.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>

#include "wound/wound.hpp"

namespace wound_command {

/// The page, RGB: mask, centroid and control points with their displacements; warped against plainly scaled
/// at several ratios; the warp's grid; depth map and profiles; ratios over days.
cv::Mat3b draw_wound_page(const wound::Photograph& photograph, const wound::PreparedWound& wound,
                          const wound::Healing& healing);

/// wound.json: every number of the page, in pixels of the photograph where the name ends in _px.
nlohmann::json wound_to_json(const wound::PreparedWound& wound, const wound::Healing& healing);

} // namespace wound_command
