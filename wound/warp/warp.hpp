// The contraction of a wound as a backward map of the patch: today's patch point -> the day-0 point whose
// skin lies there today.
//
// Choi & Chin 2014, section 3: every control point moves towards the centroid by d_n = D_n (1 - sqrt r), eq.
// (1), radial basis functions (Arad, Dyn, Reisfeld, Yeshurun 1994; here the thin plate r^2 log r) interpolate
// the motion of the skin around it, and the patch's frame is fixed. As a single step that map folds below
// r ~ 0.05, so the exact model composes many small steps, a discretised flow. Four models share one
// interface; docs/warp.md lists their errors and costs.
#pragma once
#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "shaders/shared/models.h"
#include "shaders/shared/warp.h"
#include "wound/contour.hpp"

namespace wound {

enum class WarpModel : std::uint32_t
{
    Radial = shared::WARP_RADIAL, // closed form in polar coordinates about the centroid; scales a hull of
                                  // the border exactly, never folds
    Grid = shared::WARP_GRID,     // the composed map on a grid that is finest at the centroid, interpolated
                                  // bilinearly
    Dense = shared::WARP_DENSE,   // as in the paper: one thin-plate step; folds for small r
    Composed = shared::WARP_COMPOSED // thin-plate steps of at most step_scale each: the reference
};

inline constexpr double step_scale = .62; // a full step scales lengths about the centroid by this
inline constexpr double smallest_scale =
    .02; // lower bound of sqrt r for drawing: a wound about one texel wide

/// One thin-plate step: p -> p + a0 + a1 x + a2 y + sum_i w_i |p-c_i|^2 log |p-c_i|^2. The last centres are
/// anchors that fix the patch's frame.
struct ThinPlate
{
    std::vector<cv::Point2d> centers, weights;
    std::array<cv::Point2d, 3> affine; // a0, a1, a2
    cv::Point2d apply(cv::Point2d p) const;
};

/// A backward map. A default one is the identity.
struct Warp
{
    WarpModel model = WarpModel::Radial;
    double scale = 1; // sqrt(area ratio)
    cv::Point2d centroid;
    std::vector<double> radii;      // radial: the hull's radii at day 0, at equally spaced angles from -pi
    std::vector<cv::Point2d> nodes; // grid: x and y of the i-th column and row
    cv::Mat2d grid;                 // grid: day-0 coordinates at the nodes
    std::vector<ThinPlate> steps;   // dense, composed: in order of application, from today to day 0
    cv::Point2d apply(cv::Point2d p) const;
};

/// Data shared by the warps of all days: the radial hull and the thin-plate steps at fixed scales, computed
/// once per wound.
struct ContractionFlow
{
    cv::Point2d centroid;
    std::vector<cv::Point2d> control_points;
    std::vector<double> radii;
    std::vector<ThinPlate> steps; // steps[k] maps points at scale step_scale^(k+1) back to step_scale^k
    double grid_share = 1; // of the usual number of a grid's nodes on a side: a coarser patch needs fewer
};

/// `border` and `control_points` are in patch coordinates within (-1,1). A control point within half a texel
/// of 512 of an earlier one is dropped. Throws std::runtime_error if a system cannot be solved.
ContractionFlow prepare_flow(const std::vector<cv::Point2d>& border,
                             const std::vector<cv::Point2d>& control_points, cv::Point2d centroid);

/// The map for an area ratio >= 0, clamped to at least smallest_scale^2. Continuous in the ratio.
Warp make_warp(const ContractionFlow& flow, double area_ratio, WarpModel model = WarpModel::Grid);

/// Appends the warp's numbers to `values` in the layout of shaders/shared/warp.h, in single precision.
shared::WarpHeader pack(const Warp& warp, std::vector<shared::vec2>& values);

// ---- Measuring and using warps on the CPU
// ---------------------------------------------------------------------------

/// Day-0 patch coordinates at the centres of size x size texels.
cv::Mat2d backward_map(const Warp& warp, int size);
/// A day-0 image warped to today; square, of any type that cv::remap accepts.
cv::Mat warp_image(const cv::Mat& image, const Warp& warp);

struct FoldCheck
{
    int folded_texels = 0;     // texels with a non-positive determinant
    double least_jacobian = 0; // smallest determinant of all texels, computed from their corners
};
FoldCheck check_folds(const Warp& warp, int size);

/// A day-0 curve mapped to today by the forward map (Newton's method).
Polyline outline_today(const Warp& warp, const Polyline& day0);

const char* name_of(WarpModel model);

} // namespace wound
