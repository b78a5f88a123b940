// Pictures and charts of how a wound is made and how it contracts: Figures 1, 4 and 5 of Choi & Chin 2014.
// Pictures are square, 8-bit sRGB, RGB order.
#pragma once
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "base/chart.hpp"
#include "wound/wound.hpp"

namespace wound {

inline constexpr base::Paint border_paint = base::paint(0x009646), point_paint = base::paint(0xc81e1e),
                             arrow_paint = base::paint(0x143cc8);

/// The whole photograph in a square, with the mask's outline and the patch's frame and centre.
cv::Mat3b photograph_with_mask(const Photograph& photograph, const PreparedWound& wound);

/// Draws a closed curve, in patch coordinates, on a picture of the patch.
void draw_outline(cv::Mat3b& picture, const Polyline& curve);
/// Draws a dot at each point, in patch coordinates.
void draw_points(cv::Mat3b& picture, const std::vector<cv::Point2d>& points);

/// Figure 1 (b): the border, the lines x, y = centroid + k spacing whose crossings with the border are the
/// control points, and the centroid. Spacing in patch units.
cv::Mat3b control_lines(const cv::Mat3b& color, const PreparedWound& wound, double spacing);

/// Figure 1 (c): the border, the control points at distance D_n from the centroid, and their displacements
/// d_n = D_n (1 - sqrt r), eq. (1).
cv::Mat3b displacements(const cv::Mat3b& color, const PreparedWound& wound, double area_ratio);

/// A square grid drawn on the skin on day 0, after the warp, and the warped border.
cv::Mat3b warped_grid(const Warp& warp, const PreparedWound& wound);

/// Figure 4 (a): the whole picture scaled by sqrt(area_ratio) about its centre, white around it.
cv::Mat3b plainly_scaled(const cv::Mat3b& color, double area_ratio);

/// Deep is dark; the swollen rim is lightest.
cv::Mat3b depth_picture(const cv::Mat1f& depth_mm);

/// Figure 5: height over the skin along the horizontal line through the centroid, one series per day.
base::Chart depth_profiles(const PreparedWound& wound, const Healing& healing, std::span<const double> days);

} // namespace wound
