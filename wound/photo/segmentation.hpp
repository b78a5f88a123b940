// Finds the wounds in a photograph without learned weights: regions that stand out from the skin around them
// (wound/photo/wound_candidates.hpp), each segmented by GrabCut (wound/photo/grab_cut.hpp).
#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "base/input_error.hpp"

namespace wound {

struct SegmentationHints
{
    std::optional<cv::Point> seed; // pixel inside the only wound to find
    std::optional<cv::Rect> rect;  // pixels; contains the wounds and, near its edges, skin
    bool any() const { return seed || rect; }
    bool operator==(const SegmentationHints&) const = default;
};

/// No wound was found.
struct NoWound : base::InputError
{
    using InputError::InputError;
};

/// 255 in the wounds, of the photograph's size. `srgb` is in RGB order; near-black surroundings of a cropped
/// picture are ignored. Works at up to 400 pixels a side (of the rectangle and its surroundings, if given)
/// and maps the result back. Deterministic. Throws base::InputError (`where` names the photograph) if the
/// photograph is too small or a hint lies outside it, and NoWound if no wound is found.
cv::Mat1b segment(const cv::Mat3b& srgb, const SegmentationHints& hints, std::string_view where);

/// `mask` with its components' holes filled.
cv::Mat1b fill_holes(const cv::Mat1b& mask);

/// 255 except in near-black regions that touch the photograph's edge (circular crops, letter boxes).
cv::Mat1b picture_area(const cv::Mat3b& srgb);

/// The components of a mask with at least a twentieth of the largest one's area, holes filled, largest first,
/// at most `most`. A component in a hole of a larger one belongs to the larger one.
std::vector<cv::Mat1b> components(const cv::Mat1b& mask, std::size_t most);

/// Checks a user's mask: it must have the photograph's size and not be empty. Returns its largest component
/// with holes filled; where that touches the picture's edge, the edge is its border. Throws base::InputError.
cv::Mat1b checked_mask(const cv::Mat1b& mask, cv::Size photograph, std::string_view where);

/// Area of the intersection / area of the union; 1 for two empty masks.
double intersection_over_union(const cv::Mat1b& a, const cv::Mat1b& b);

} // namespace wound
