// Compares a picture with a golden one, with tolerances for machines that round differently. A mismatch
// means "changed", not necessarily "wrong".
#pragma once
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace base {

/// Rounding may change every pixel by at most `usual`; a few pixels at edges may change more, but none by
/// more than `hard`. A test with a wider bound gives the reason beside it.
struct CompareBounds
{
    int usual = 3;             // of 255, any channel
    double exceptions = 0.001; // share of pixels that may differ by more than `usual`
    int hard = 32;             // of 255; no pixel may differ by more
};

struct Comparison
{
    bool equal = false;
    int largest_difference = 0; // of 255
    cv::Point largest_at{-1, -1};
    double share_above_usual = 0;
    std::string report; // one line: the differences and their bounds
};

/// The first pixel in row order with a NaN or infinite channel; `linear` is 32-bit float with any number of
/// channels.
std::optional<cv::Point> first_non_finite(const cv::Mat& linear);

/// Pictures of different size are not equal.
Comparison compare_images(const cv::Mat3b& actual, const cv::Mat3b& expected,
                          const CompareBounds& bounds = {});

/// |actual - expected| times `gain`, saturated. Both must have the same size.
cv::Mat3b amplified_difference(const cv::Mat3b& actual, const cv::Mat3b& expected, int gain = 16);

/// A golden test: `linear`, the float picture that `actual` encodes, must be finite; then `actual` must equal
/// the PNG `golden` within the bounds. On failure NAME_actual.png, NAME_expected.png and NAME_difference.png
/// are written into `failures`. A missing golden file is a failure too: inspect NAME_actual.png and copy it
/// to `golden`.
Comparison compare_with_golden(const cv::Mat& linear, const cv::Mat3b& actual,
                               const std::filesystem::path& golden, const std::filesystem::path& failures,
                               const CompareBounds& bounds = {});

} // namespace base
