#include "base/image_compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

#include "base/image_io.hpp"

namespace base {
namespace {

int pixel_difference(const cv::Vec3b& a, const cv::Vec3b& b)
{
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

std::string judge(const Comparison& found, const CompareBounds& bounds)
{
    return fmt::format(
        "largest difference {}/255 at ({}, {}) (bound {}), {:.4f} % of pixels above {}/255 (bound {:.4f} %)",
        found.largest_difference, found.largest_at.x, found.largest_at.y, bounds.hard,
        100 * found.share_above_usual, bounds.usual, 100 * bounds.exceptions);
}

} // namespace

std::optional<cv::Point> first_non_finite(const cv::Mat& linear)
{
    CV_Assert(linear.empty() || linear.depth() == CV_32F);
    const int channels = linear.channels();
    for (int y = 0; y < linear.rows; ++y) {
        const float* row = linear.ptr<float>(y);
        for (int i = 0; i < linear.cols * channels; ++i)
            if (!std::isfinite(row[i]))
                return cv::Point(i / channels, y);
    }
    return std::nullopt;
}

Comparison compare_images(const cv::Mat3b& actual, const cv::Mat3b& expected, const CompareBounds& bounds)
{
    Comparison found;
    if (actual.size() != expected.size()) {
        found.report = fmt::format("size is {} x {}, expected {} x {}", actual.cols, actual.rows,
                                   expected.cols, expected.rows);
        return found;
    }
    if (actual.empty()) {
        found.report = "the pictures are empty";
        return found;
    }
    std::size_t above = 0;
    for (int y = 0; y < actual.rows; ++y)
        for (int x = 0; x < actual.cols; ++x) {
            const int difference = pixel_difference(actual(y, x), expected(y, x));
            above += difference > bounds.usual;
            if (difference > found.largest_difference) {
                found.largest_difference = difference;
                found.largest_at = {x, y};
            }
        }
    found.share_above_usual = static_cast<double>(above) / static_cast<double>(actual.total());
    found.equal = found.largest_difference <= bounds.hard && found.share_above_usual <= bounds.exceptions;
    found.report = judge(found, bounds);
    return found;
}

cv::Mat3b amplified_difference(const cv::Mat3b& actual, const cv::Mat3b& expected, int gain)
{
    cv::Mat difference;
    cv::absdiff(actual, expected, difference);
    return difference * gain; // OpenCV saturates
}

Comparison compare_with_golden(const cv::Mat& linear, const cv::Mat3b& actual,
                               const std::filesystem::path& golden, const std::filesystem::path& failures,
                               const CompareBounds& bounds)
{
    const auto file = [&](const char* what) {
        return failures / fmt::format("{}_{}.png", golden.stem().string(), what);
    };
    Comparison found;
    cv::Mat3b expected;
    if (std::filesystem::exists(golden)) {
        expected = read_rgb(golden);
        found = compare_images(actual, expected, bounds);
    } else
        found.report = fmt::format("{} does not exist", golden.string());
    if (const auto where = first_non_finite(linear)) {
        found.equal = false;
        found.report = fmt::format("the linear picture is NaN or infinite at ({}, {})", where->x, where->y);
    }
    if (found.equal)
        return found;

    std::filesystem::create_directories(failures);
    write_png(file("actual"), actual);
    if (!expected.empty())
        write_png(file("expected"), expected);
    if (!expected.empty() && expected.size() == actual.size())
        write_png(file("difference"), amplified_difference(actual, expected));
    found.report += fmt::format("; pictures in {}", failures.string());
    return found;
}

} // namespace base
