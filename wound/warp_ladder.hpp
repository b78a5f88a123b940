// Measures the ladder of warps (wound/warp.hpp): error against the composed map, area, folds and cost of each
// rung, over shapes that try it. docs/warp.md is made from it.
#pragma once
#include <string>
#include <vector>

#include "wound/contour.hpp"
#include "wound/warp.hpp"

namespace wound {

struct LadderShape
{
    std::string name;
    Polyline border; // patch coordinates
    cv::Point2d centroid;
};

/// Circle, star, ragged, crescent, a 20 : 1 cut, a disk cut in half by the photograph's edge, and a circle
/// near the patch's frame.
std::vector<LadderShape> ladder_shapes();

struct LadderRow
{
    std::string shape;
    WarpRung rung = WarpRung::grid;
    double ratio = 1;
    double error_texels = 0; // largest distance from the composed map's day-0 point, texels of 512 x 512
    double wound_error_texels = 0; // the same inside today's wound and twice as far out
    double area_error = 0;         // area of today's wound / (ratio x initial area) - 1
    int folded_texels = 0;         // of 512 x 512
    double least_jacobian = 0;
    double make_ms = 0;          // once per day
    double ms_per_megatexel = 0; // evaluation on the CPU in double precision, one thread
};

inline constexpr double kLadderRatios[] = {1.2, .9, .6, .4, .2, .1, .05, .01};

std::vector<LadderRow> measure_ladder(const std::vector<LadderShape>& shapes);

/// For each rung and ratio the worst over all shapes, then for each rung and shape the worst over all ratios:
/// two Markdown tables.
std::string ladder_markdown(const std::vector<LadderRow>& rows);

/// Where the warp carries a curve of day 0: the forward map, by Newton's method.
Polyline outline_today(const Warp& warp, const Polyline& day0);

const char* name_of(WarpRung rung);

} // namespace wound
