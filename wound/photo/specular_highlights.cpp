#include "wound/photo/specular_highlights.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "base/smoothstep.hpp"

namespace wound {
namespace {

using cv::Vec3f;

/// Strength 0..1 of the highlight at each pixel.
cv::Mat1f find_highlights(const cv::Mat3f& color, const cv::Mat1f& coverage, int width)
{
    cv::Mat1f least(color.size()), highlight(color.size());
    for (int y = 0; y < color.rows; ++y)
        for (int x = 0; x < color.cols; ++x)
            least(y, x) = std::min({color(y, x)[0], color(y, x)[1], color(y, x)[2]});
    // A lamp adds the same to all channels, so highlights stand out in the smallest channel. The rest of that
    // channel is smooth, so a quarter of the resolution is enough for it.
    cv::Mat1f without_spots;
    cv::resize(least, without_spots, {}, .25, .25, cv::INTER_AREA);
    cv::morphologyEx(without_spots, without_spots, cv::MORPH_OPEN,
                     cv::Mat1b::ones(width / 4 + 1, width / 4 + 1));
    cv::resize(without_spots, without_spots, least.size(), 0, 0, cv::INTER_LINEAR);
    cv::Mat1f inner; // coverage without the border, where the mask may contain skin
    cv::erode(coverage, inner, cv::Mat1b::ones(7, 7));
    for (int y = 0; y < color.rows; ++y)
        for (int x = 0; x < color.cols; ++x) {
            const Vec3f& c = color(y, x);
            const float most = std::max({c[0], c[1], c[2]}), saturation = (most - least(y, x)) / most;
            const float bright = std::lerp(base::smoothstep(.75f, .95f, most),
                                           base::smoothstep(.12f, .28f, most), inner(y, x));
            highlight(y, x) = base::smoothstep(.04f, .12f, least(y, x) - without_spots(y, x)) *
                              (1 - base::smoothstep(.35f, .6f, saturation)) * bright;
        }
    return highlight;
}

} // namespace

void remove_highlights(cv::Mat3f& color, const cv::Mat1f& coverage, float radius)
{
    const int width = 2 * std::clamp(int(.3f * radius), 2, 60) + 1;
    cv::Mat1f highlight = find_highlights(color, coverage, width);
    if (cv::countNonZero(highlight) == 0)
        return;
    cv::dilate(highlight, highlight, cv::Mat1b::ones(5, 5));
    cv::GaussianBlur(highlight, highlight, {5, 5}, 1);
    cv::Mat3f dull(color.size());
    cv::Mat1f weight(color.size());
    for (int y = 0; y < color.rows; ++y)
        for (int x = 0; x < color.cols; ++x) {
            weight(y, x) = 1.001f - highlight(y, x);
            dull(y, x) = color(y, x) * weight(y, x);
        }
    cv::boxFilter(dull, dull, -1, {2 * width + 1, 2 * width + 1});
    cv::boxFilter(weight, weight, -1, {2 * width + 1, 2 * width + 1});
    for (int y = 0; y < color.rows; ++y)
        for (int x = 0; x < color.cols; ++x)
            color(y, x) += (dull(y, x) * (1 / weight(y, x)) - color(y, x)) * (.85f * highlight(y, x));
}

} // namespace wound
