// Agreement of a predicted wound with one observed on a later day. The photographs need no registration: the
// centroids are aligned, so size and shape are compared, not position.
#pragma once
#include "wound/wound.hpp"

namespace wound {

/// The mask predicted for this area ratio, in pixels of the photograph that the wound was prepared from.
cv::Mat1b predicted_mask(const PreparedWound& wound, double area_ratio);

struct ContourAgreement
{
    double intersection_over_union = 0; // of the centred masks
    double area_ratio = 0;              // predicted / observed
    double border_distance_px = 0;      // mean distance from the observed border to the predicted one
};

/// Masks may differ in size; both must hold a wound.
ContourAgreement agreement(const cv::Mat1b& predicted, const cv::Mat1b& observed);

} // namespace wound
