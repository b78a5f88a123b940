// Samples float images like GPU textures: bilinear with clamp to edge, linear between mip levels. Texture
// coordinates are 0..1 over the image.
#pragma once
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

namespace base {

/// The image and its box-filtered mip levels, each half the size (rounded down, at least 1) of the previous,
/// down to 1 x 1. Floats with any number of channels.
std::vector<cv::Mat> mip_levels(const cv::Mat& image);

/// `image` has `channels` floats per texel.
template <int channels>
cv::Vec<double, channels> sample(const cv::Mat& image, cv::Point2d uv)
{
    using Texel = cv::Vec<float, channels>;
    using Value = cv::Vec<double, channels>;
    CV_DbgAssert(image.type() == cv::traits::Type<Texel>::value);
    const double x = std::clamp(uv.x * image.cols - .5, 0., image.cols - 1.),
                 y = std::clamp(uv.y * image.rows - .5, 0., image.rows - 1.);
    const int x0 = static_cast<int>(x), x1 = std::min(x0 + 1, image.cols - 1);
    const int y0 = static_cast<int>(y), y1 = std::min(y0 + 1, image.rows - 1);
    const double fx = x - x0, fy = y - y0;
    const Texel *above = image.ptr<Texel>(y0), *below = image.ptr<Texel>(y1);
    return (1 - fy) * ((1 - fx) * Value(above[x0]) + fx * Value(above[x1])) +
           fy * ((1 - fx) * Value(below[x0]) + fx * Value(below[x1]));
}

/// Interpolates what `sample_level` says of the levels of mip_levels(). `lod` 0 is the image itself; larger
/// values are clamped.
template <typename SampleLevel>
auto between_levels(const std::vector<cv::Mat>& levels, double lod, const SampleLevel& sample_level)
{
    const double level = std::clamp(lod, 0., static_cast<double>(levels.size() - 1));
    const auto finer = static_cast<std::size_t>(level);
    const double toward_coarser = level - static_cast<double>(finer);
    const auto value = sample_level(levels[finer]);
    if (toward_coarser == 0)
        return value;
    return decltype(value)((1 - toward_coarser) * value + toward_coarser * sample_level(levels[finer + 1]));
}

template <int channels>
cv::Vec<double, channels> sample(const std::vector<cv::Mat>& levels, cv::Point2d uv, double lod)
{
    return between_levels(levels, lod, [&](const cv::Mat& level) { return sample<channels>(level, uv); });
}

/// One level smoothed by a cubic B-spline, whose slope has no kinks at the texels' centres.
template <int channels>
cv::Vec<double, channels> sample_smooth(const cv::Mat& image, cv::Point2d uv)
{
    const double at[2] = {uv.x * image.cols - .5, uv.y * image.rows - .5};
    double weights[2][4];
    cv::Point first;
    for (int axis = 0; axis < 2; ++axis) {
        const double whole = std::floor(at[axis]), f = at[axis] - whole, g = 1 - f;
        (axis == 0 ? first.x : first.y) = static_cast<int>(whole) - 1;
        const double four[4] = {g * g * g / 6, (4 + 3 * f * f * (f - 2)) / 6, (4 + 3 * g * g * (g - 2)) / 6,
                                f * f * f / 6};
        std::copy(four, four + 4, weights[axis]);
    }
    cv::Vec<double, channels> sum = cv::Vec<double, channels>::all(0);
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            sum +=
                weights[0][i] * weights[1][j] *
                cv::Vec<double, channels>(image.at<cv::Vec<float, channels>>(
                    std::clamp(first.y + j, 0, image.rows - 1), std::clamp(first.x + i, 0, image.cols - 1)));
    return sum;
}

template <int channels>
cv::Vec<double, channels> sample_smooth(const std::vector<cv::Mat>& levels, cv::Point2d uv, double lod)
{
    return between_levels(levels, lod,
                          [&](const cv::Mat& level) { return sample_smooth<channels>(level, uv); });
}

} // namespace base
