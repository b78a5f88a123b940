// Synthetic photographs of wounds on skin, for tests: noise, uneven light, a known mask.
#pragma once
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "wound/wound.hpp"

namespace testing_wounds {

/// Skin with a red, mottled wound where `outline(dx, dy) < 1`; (dx, dy) is the offset from `center`, pixels.
template <typename Outline>
wound::Photograph photograph(cv::Size size, cv::Point2d center, Outline outline,
                             const cv::Vec3d& bed = {150, 45, 40})
{
    wound::Photograph result{cv::Mat3b(size), cv::Mat1b::zeros(size)};
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 4);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const bool inside = outline(x - center.x, y - center.y) < 1;
            const double light = .85 + .3 * x / size.width;
            const double mottle = inside ? 12 * std::sin(.21 * x) * std::cos(.17 * y) : 0;
            const cv::Vec3d color = inside ? bed : cv::Vec3d(205, 160, 135);
            for (int c = 0; c < 3; ++c)
                result.srgb(y, x)[c] = cv::saturate_cast<uchar>(color[c] * light + mottle + noise(random));
            result.mask(y, x) = inside ? 255 : 0;
        }
    return result;
}

inline auto ellipse(double a, double b)
{
    return [a, b](double dx, double dy) { return dx * dx / (a * a) + dy * dy / (b * b); };
}

} // namespace testing_wounds
