// The contraction of a wound as a map of the patch, backward: today's patch point -> the day-0 point whose
// skin lies there today.
//
// Choi & Chin 2014, section 3: every control point moves towards the centroid by d_n = D_n (1 - sqrt r), eq.
// (1), and radial basis functions (Arad, Dyn, Reisfeld, Yeshurun 1994; here the thin plate r^2 log r) carry
// the skin around it along, while the patch's frame stays. In one step that map folds below r ~ 0.05, so the
// exact model composes many small steps, a discretised flow. Four models behind one interface; docs/warp.md
// holds their errors and costs.
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
    Radial = shared::WARP_RADIAL, // closed form in star-shaped coordinates about the centroid; scales a hull
                                  // of the border exactly, never folds
    Grid = shared::WARP_GRID,   // the composed map on a grid that is finest at the centroid, interpolated
                                // bilinearly
    Dense = shared::WARP_DENSE, // the paper's: one thin-plate step; folds for small r
    Composed = shared::WARP_COMPOSED // thin-plate steps of at most step_scale each: the reference
};

inline constexpr double step_scale = .62; // a full step scales lengths about the centroid by this
inline constexpr double smallest_scale =
    .02; // sqrt r of the most contracted wound drawn: about a texel; below it is closed

/// One thin-plate step: p -> p + a0 + a1 x + a2 y + sum_i w_i |p-c_i|^2 log |p-c_i|^2. The last centres are
/// anchors on the patch's frame, which hold it still.
struct ThinPlate
{
    std::vector<cv::Point2d> centers, weights;
    std::array<cv::Point2d, 3> affine; // of 1, x, y
    cv::Point2d apply(cv::Point2d p) const;
};

/// A backward map. A default one is the identity.
struct Warp
{
    WarpModel model = WarpModel::Radial;
    double scale = 1; // sqrt(area ratio)
    cv::Point2d centroid;
    std::vector<double> radii;      // radial: of the hull at day 0, at equal angles from -pi
    std::vector<cv::Point2d> nodes; // grid: x and y of the i-th column and row
    cv::Mat2d grid;                 // grid: day-0 coordinates at the nodes
    std::vector<ThinPlate> steps;   // dense, composed: today's first
    cv::Point2d apply(cv::Point2d p) const;
};

/// What the warps of all days share: the radial hull and the thin-plate steps at fixed scales, solved once
/// per wound.
struct ContractionFlow
{
    cv::Point2d centroid;
    std::vector<cv::Point2d> control_points;
    std::vector<double> radii;
    std::vector<ThinPlate> steps; // steps[k] maps points at scale step_scale^(k+1) back to step_scale^k
};

/// `border` and `control_points` in patch coordinates within (-1,1). Of control points that coincide to half
/// a texel of 512 the first is kept. Throws std::runtime_error when a system cannot be solved.
ContractionFlow prepare_flow(const std::vector<cv::Point2d>& border,
                             const std::vector<cv::Point2d>& control_points, cv::Point2d centroid);

/// The map for an area ratio >= 0; ratios under smallest_scale^2 are drawn as that. Continuous in the ratio.
Warp make_warp(const ContractionFlow& flow, double area_ratio, WarpModel model = WarpModel::Grid);

/// Appends the warp's numbers to `values` in the layout of shaders/shared/warp.h, in single precision.
shared::WarpHeader pack(const Warp& warp, std::vector<shared::vec2>& values);

// ---- Measuring and using warps on the CPU
// ---------------------------------------------------------------------------

/// Day-0 patch coordinates at the centres of size x size texels.
cv::Mat2d backward_map(const Warp& warp, int size);
/// `image` of day 0 as it lies today; any type cv::remap takes.
cv::Mat warp_image(const cv::Mat& image, const Warp& warp);

struct FoldCheck
{
    int folded_texels = 0;     // with a non-positive determinant
    double least_jacobian = 0; // least determinant over all texels, from the texel's corners
};
FoldCheck check_folds(const Warp& warp, int size);

/// Where the warp carries a curve of day 0: the forward map, by Newton's method.
Polyline outline_today(const Warp& warp, const Polyline& day0);

const char* name_of(WarpModel model);

} // namespace wound
