// The part of the patch that a wound covers on any day; texels outside it need never be computed.
#pragma once
#include "wound/wound.hpp"

namespace wound {

/// Rectangle, in texels of the patch, of all points whose opacity is above 0 on some day of the healing, with
/// a margin for filters. It depends on the wound and its curve, not on the day; never empty. Call it after
/// match_to_skin(), which sets the patch's opacity.
cv::Rect drawn_region(const PreparedWound& wound, const Healing& healing);

} // namespace wound
