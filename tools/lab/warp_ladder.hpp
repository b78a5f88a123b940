// Measures all warp models (wound/warp/warp.hpp): error against the composed map, area, folds and cost at
// each ratio, on test shapes. docs/warp.md contains the results.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "wound/contour.hpp"
#include "wound/warp/warp.hpp"

namespace lab {

struct LadderShape
{
    std::string name;
    wound::Polyline border; // patch coordinates
    cv::Point2d centroid;
};

/// Circle, star, ragged, crescent, a 20 : 1 cut, a disk cut in half by the photograph's edge, and a circle
/// near the patch's frame.
std::vector<LadderShape> ladder_shapes();

struct LadderRow
{
    std::string shape;
    wound::WarpModel model = wound::WarpModel::Grid;
    double ratio = 1;
    double error_texels = 0;      // largest distance from the composed map's day-0 point, texels of 512 x 512
    double near_error_texels = 0; // the same within twice today's radius of the centroid
    double area_error = 0;        // area of today's wound / (ratio x initial area) - 1
    int folded_texels = 0;        // of 512 x 512
    double least_jacobian = 0;
    double make_ms = 0;          // once per day; CPU time
    double ms_per_megatexel = 0; // CPU time, double precision, one thread
};

inline constexpr double ladder_ratios[] = {1.2, .9, .6, .4, .2, .1, .05, .01};
inline constexpr wound::WarpModel warp_models[] = {wound::WarpModel::Radial, wound::WarpModel::Grid,
                                                   wound::WarpModel::Dense, wound::WarpModel::Composed};
inline constexpr double error_limit = .25; // texels, of the default model

/// One row for each ratio and model.
std::vector<LadderRow> measure_ladder(const LadderShape& shape);

/// Among the models within error_limit and without folds in all rows, the one with the lowest maximum cost.
std::optional<wound::WarpModel> cheapest_exact(const std::vector<LadderRow>& rows);

/// A Markdown table: each model's worst values over all rows, and ranges of its cost.
std::string ladder_summary(const std::vector<LadderRow>& rows);
/// Markdown tables of error, area, folds and cost relative to the grid's, by model and ratio (rows) and
/// shape (columns).
std::string ladder_tables(const std::vector<LadderRow>& rows);
/// All rows, with column names; units as in LadderRow.
std::string ladder_csv(const std::vector<LadderRow>& rows);
/// RGB picture with one chart per shape: error over ratio, both logarithmic, with error_limit and the folds.
cv::Mat3b draw_ladder(const std::vector<LadderRow>& rows);

} // namespace lab
