// Finds the wounds in a photograph without learned weights: regions that stand out from the skin around them
// (wound/wound_candidates.hpp), each cut out by GrabCut (wound/grab_cut.hpp).
#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "base/input_error.hpp"

namespace wound {

struct SegmentationHints
{
    std::optional<cv::Point> seed; // pixel inside the wound: this one alone
    std::optional<cv::Rect> rect;  // pixels; the wounds lie inside, near its borders is skin
    bool any() const { return seed || rect; }
    bool operator==(const SegmentationHints&) const = default;
};

/// There is no wound to be seen.
struct NoWound : base::InputError
{
    using InputError::InputError;
};

/// 255 in the wounds, of the photograph's size. `srgb` in RGB order; near-black surroundings of a cropped
/// picture count as no part of it. Works at up to 400 pixels a side (of the rectangle and its surroundings
/// when there is one) and maps the result back. Deterministic. Throws base::InputError (`where` names the
/// photograph) for too small a photograph or hints outside it, NoWound for one with no wound in it.
cv::Mat1b segment(const cv::Mat3b& srgb, const SegmentationHints& hints, std::string_view where);

/// `mask` with what its components enclose.
cv::Mat1b fill_holes(const cv::Mat1b& mask);

/// 255 where there is a picture: all but near-black pixels joined to its edge (circular crops, letter boxes).
cv::Mat1b picture_area(const cv::Mat3b& srgb);

/// The components of a mask that hold at least a twentieth of the largest one's area, holes filled, largest
/// first, at most `most`: several wounds in one photograph. What lies in the hole of a larger one belongs to
/// it.
std::vector<cv::Mat1b> components(const cv::Mat1b& mask, std::size_t most);

/// Checks a mask that the user gives: of the photograph's size, not empty. Returns its largest component with
/// holes filled; where that touches the picture's edge, the edge is taken for its border: all of it when the
/// mask is full.
/// Throws base::InputError.
cv::Mat1b checked_mask(const cv::Mat1b& mask, cv::Size photograph, std::string_view where);

/// Area of the intersection / area of the union; 1 for two empty masks.
double intersection_over_union(const cv::Mat1b& a, const cv::Mat1b& b);

} // namespace wound
