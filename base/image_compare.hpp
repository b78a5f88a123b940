// Compares a picture with a golden one on machines that round differently. A golden picture says "changed",
// never "wrong".
#pragma once
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace base {

/// Two bounds: rounding may move every pixel a little, an edge may move a few pixels more, and no pixel may
/// move far. A test that needs a wider bound says why beside it.
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
    std::string report; // one line: what was found against which bound
};

/// The first pixel, in reading order, with a NaN or infinite channel; `linear` holds floats of any number of
/// channels.
std::optional<cv::Point> first_non_finite(const cv::Mat& linear);

/// Pictures of different size are not equal.
Comparison compare_images(const cv::Mat3b& actual, const cv::Mat3b& expected,
                          const CompareBounds& bounds = {});

/// |actual - expected| times `gain`, saturated: what moved, made visible. Same sizes.
cv::Mat3b amplified_difference(const cv::Mat3b& actual, const cv::Mat3b& expected, int gain = 16);

/// A golden test: `linear`, the float picture that `actual` encodes, must be finite; then `actual` must equal
/// the PNG `golden` within the bounds. On failure NAME_actual.png, NAME_expected.png and NAME_difference.png
/// are written into `failures`. A golden file that does not exist is a failure that leaves NAME_actual.png to
/// be looked at and taken.
Comparison compare_with_golden(const cv::Mat& linear, const cv::Mat3b& actual,
                               const std::filesystem::path& golden, const std::filesystem::path& failures,
                               const CompareBounds& bounds = {});

} // namespace base
