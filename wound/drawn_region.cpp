#include "wound/drawn_region.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace wound {

namespace {

constexpr double margin =
    2; // texels, for bilinear sampling and the difference of a quarter texel between the warp models

/// Smallest and largest ratio of the area inside the border over all days.
std::pair<double, double> border_ratios(const Healing& healing)
{
    double least = 1, largest = 1;
    for (double day = 1e-3; day < 1e9; day *= 1.1) {
        const double ratio = healing_at(healing, day).border_ratio;
        least = std::min(least, ratio);
        largest = std::max(largest, ratio);
    }
    return {least, largest};
}

/// Whether any texel on the rectangle's outline is opaque under the warp. The warp is a homeomorphism of the
/// patch that fixes its frame, so if no texel on the outline is opaque, none outside it is.
bool outline_shows(const cv::Rect& region, const Warp& warp, const cv::Mat1f& to_opaque)
{
    const int n = to_opaque.rows;
    const auto shows = [&](int x, int y) {
        const cv::Point2d today((x + .5) * 2 / n - 1, (y + .5) * 2 / n - 1), day0 = warp.apply(today);
        // The shader blurs where the warp compresses many day-0 texels into one.
        const double blur = std::max(1., cv::norm(day0 - warp.centroid) / cv::norm(today - warp.centroid));
        const auto texel = [&](double t) { return std::clamp(int((t + 1) * n / 2), 0, n - 1); };
        return to_opaque(texel(day0.y), texel(day0.x)) < margin * blur;
    };
    constexpr int step = 4; // texels; the map is smooth away from the wound
    for (int x = region.x; x < region.br().x; x += step)
        if ((region.y > 0 && shows(x, region.y)) || (region.br().y < n && shows(x, region.br().y - 1)))
            return true;
    for (int y = region.y; y < region.br().y; y += step)
        if ((region.x > 0 && shows(region.x, y)) || (region.br().x < n && shows(region.br().x - 1, y)))
            return true;
    return false;
}

} // namespace

cv::Rect drawn_region(const PreparedWound& wound, const Healing& healing)
{
    const cv::Mat1f& opacity = wound.patch.opacity;
    const cv::Rect patch({}, opacity.size());
    cv::Mat1f to_opaque;
    cv::distanceTransform(opacity <= 0, to_opaque, cv::DIST_L2, cv::DIST_MASK_3);
    const auto grown = [&](const cv::Rect& rect, int by) {
        return cv::Rect(rect.tl() - cv::Point(by, by), rect.br() + cv::Point(by, by)) & patch;
    };
    cv::Rect region = grown(cv::boundingRect(opacity > 0), 2 * int(margin));
    if (region.empty())
        return {patch.width / 2, patch.height / 2, 1, 1};

    const auto [least, largest] = border_ratios(healing);
    constexpr double ratio_step = .75; // factor between the ratios that are tested
    for (double ratio = largest;; ratio = std::max(least, ratio_step * ratio)) {
        const Warp warp = make_warp(wound.flow, ratio, WarpModel::Composed);
        while (region != patch && outline_shows(region, warp, to_opaque))
            region = grown(region, std::max(1, patch.width / 64));
        if (ratio <= std::max(least, smallest_scale * smallest_scale) || region == patch)
            return region;
    }
}

} // namespace wound
