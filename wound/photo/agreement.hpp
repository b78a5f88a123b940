// How well a predicted wound agrees with one observed on a later day, in photographs that nobody registered:
// the two are laid centroid on centroid, so what is judged is size and shape, not place.
#pragma once
#include "wound/wound.hpp"

namespace wound {

/// Today's mask in the pixels of the photograph that the wound was prepared from.
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
