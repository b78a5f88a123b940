// The part of the patch that a wound ever shows: what lies outside it need not be computed on any day.
#pragma once
#include "wound/wound.hpp"

namespace wound {

/// Texels of the patch that hold every point whose opacity is above 0 on some day of the healing, with a
/// margin for the filters that read them. Fixed for a wound and its curve, so that nothing is made anew as
/// days pass; never empty. The patch must already be matched to the skin, which decides its opacity.
cv::Rect drawn_region(const PreparedWound& wound, const Healing& healing);

} // namespace wound
