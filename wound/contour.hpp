// The wound's border, centroid and control points from its mask (Choi & Chin 2014, section 3, Fig. 1b). Patch
// coordinates throughout (wound/wound.hpp): the mask is square.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

namespace wound {

using Polyline = std::vector<cv::Point2d>; // closed: the last point is joined to the first

/// The level set of a coverage map 0..1 by marching squares: all closed curves, subpixel, counter-clockwise
/// on screen around regions above `level`. Pixels outside the map count as 0.
std::vector<Polyline> level_curves(const cv::Mat1f& coverage, float level = .5F);

/// The outer border of the largest component: the level curve that encloses the largest area.
Polyline border_of(const cv::Mat1f& coverage);

/// Enclosed area, positive for a counter-clockwise curve on screen.
double signed_area(const Polyline& curve);

struct Moments
{
    double area = 0; // patch units squared
    cv::Point2d centroid;
};
/// Area and centroid from the moments of the coverage (Sonka, Hlavac, Boyle 1998); subpixel for an
/// antialiased mask.
Moments moments_of(const cv::Mat1f& coverage);

inline constexpr int fewest_control_points = 8;
inline constexpr int most_control_points = 512;

/// Points where the lines x = centroid.x + k spacing and y = centroid.y + k spacing cross the border, in
/// order along it. Crossings nearer than a quarter of the spacing along the border are merged into their
/// middle. The spacing is adjusted until there are fewest_control_points to most_control_points points.
Polyline control_points(const Polyline& border, cv::Point2d centroid, double spacing);

/// The widest spacing at which the polygon of control points deviates from the border by at most `tolerance`
/// times the square root of the enclosed area: narrow for a strongly curved border, wide for a smooth one.
/// From 1/48 to 1/12 of the wound's extent.
double spacing_from_curvature(const Polyline& border, cv::Point2d centroid, double tolerance = .012);

} // namespace wound
