// The kernel of transport `separable`: J. Jimenez et al. 2015, "Separable subsurface scattering" (Computer
// Graphics Forum 34). A profile R(x, y) is replaced by a(x) a(y), so that two passes along the axes of the
// picture spread the light. Of the paper's kernels this is the analytic pre-integrated one, a(x) = the
// integral of R(x, y) over y: exact for light that changes along one axis only, and for sums of such light.
// The profile is that of our tissue, Burley's, and each sample has the integral of a over its share of the
// axis.
#pragma once
#include <array>

#include "base/color.hpp"
#include "shaders/shared/screen_diffusion.h"

namespace optics {

/// Light falls on one half of a plane: the brightness of the dark half, relative to full, at this distance
/// from the border, by Burley's profile. The integral of a beyond it. Same unit, both at least 0.
double beyond_edge(double distance, double width);

/// Samples along an axis, the middle one first. place: in widths of the widest channel; weight: per channel,
/// their sum is 1. Places grow with the square of their number, as in the authors' program. `width`: of the
/// channels' profiles, in any unit; a channel without width keeps its light in the middle.
struct SeparableTap
{
    double place = 0;
    base::Color weight{0, 0, 0};
};
std::array<SeparableTap, shared::SEPARABLE_TAPS> separable_kernel(const base::Color& width);

} // namespace optics
