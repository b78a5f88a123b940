// The wound's border, centroid and control points from its mask (Choi & Chin 2014, section 3, Fig. 1b). Patch
// coordinates throughout (wound/wound.hpp): the mask is square.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

namespace wound {

using Polyline = std::vector<cv::Point2d>; // closed: the last point is joined to the first

/// Coverage 0..1 to the .5 level set, by marching squares: every closed curve, subpixel, counter-clockwise as
/// seen on screen around what is inside. Pixels outside the mask count as 0.
std::vector<Polyline> level_curves(const cv::Mat1f& coverage, float level = .5F);

/// The outer border of the largest component: the level curve of the largest area.
Polyline border_of(const cv::Mat1f& coverage);

/// Enclosed area, positive for a counter-clockwise curve on screen.
double signed_area(const Polyline& curve);

struct Moments
{
    double area = 0; // patch units squared
    cv::Point2d centroid;
};
/// Centroid by the first moments of the coverage (Sonka, Hlavac, Boyle 1998), which an antialiased mask makes
/// subpixel.
Moments moments_of(const cv::Mat1f& coverage);

inline constexpr int fewest_control_points = 8;
inline constexpr int most_control_points = 512;

/// Where lines x = centroid.x + k spacing and y = centroid.y + k spacing cross the border, in order along it.
/// Crossings nearer than a quarter of the spacing along the border become one, in their middle. The spacing
/// shrinks until there are at least fewest_control_points, and grows until there are at most
/// most_control_points.
Polyline control_points(const Polyline& border, cv::Point2d centroid, double spacing);

/// The widest spacing at which straight lines between the control points stray from the border by at most
/// `tolerance` of the square root of the area it encloses: narrow on a strongly curved border, wide on a
/// smooth one. Between a 48th and a 12th of the wound's extent.
double spacing_from_curvature(const Polyline& border, cv::Point2d centroid, double tolerance = .012);

} // namespace wound
