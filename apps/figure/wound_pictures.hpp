// Figures 1, 4, 5 and 6: the wound's control points, warp, depth and colour.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "apps/figure/workbench.hpp"
#include "base/chart.hpp"
#include "wound/optics/shading.hpp"

namespace figure_command {

/// Area of the warped mask / area of the mask.
double warped_area_ratio(const wound::PreparedWound& wound, const wound::Warp& warp);

/// Figure 5's second chart: the deepest point of each day's profile, and depth0 sqrt(r) over the days.
base::Chart deepest_chart(const base::Chart& profiles, const std::vector<double>& days,
                          const wound::Healing& healing);

/// Colour of a wound whose shape stays while it recovers (Figure 6).
struct RecoveringColor
{
    double recovery = 0;   // r of eq. (4)
    cv::Mat3f color;       // linear, the whole patch on the face's skin
    cv::Mat3f reflectance; // linear, R of eq. (4)
    double to_skin = 0;    // CIEDE2000 between the bed's mean colour and the skin's
};
/// Published: eq. (4) as printed with Table 1 and eqs. (2), (3). Corrected: the default form of eq. (4),
/// tissue and reflectance model.
std::vector<RecoveringColor> recovering_colors(const scene::LoadedScene& scene, Equations equations,
                                               const std::vector<double>& recoveries);

} // namespace figure_command
