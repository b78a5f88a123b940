#include "reference/picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "base/tone_curve.hpp"

namespace reference {
namespace {

base::Lab encoded_lab(const cv::Vec3f& sum, float samples, double alpha, double stops, double height)
{
    return base::shown_lab(base::Color(sum) / double(samples), alpha, stops, height);
}

} // namespace

cv::Mat4f Picture::radiance() const
{
    cv::Mat4f all(size_);
    const float n = float(samples());
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x) {
            const PixelSums& pixel = sums(x, y);
            const cv::Vec3f light = (pixel.diffuse + pixel.specular) / n;
            all(y, x) = {light[0], light[1], light[2], pixel.alpha / n};
        }
    return all;
}

cv::Mat3f Picture::mean(cv::Vec3f PixelSums::*sum) const
{
    cv::Mat3f means(size_);
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x)
            means(y, x) = sums(x, y).*sum / float(samples());
    return means;
}

cv::Mat3f Picture::error(cv::Vec3f PixelSums::*sum, cv::Vec3f PixelSums::*squares) const
{
    cv::Mat3f errors(size_);
    const double n = samples();
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double mean = double((sums(x, y).*sum)[c]) / n;
                const double variance = std::max(0.0, double((sums(x, y).*squares)[c]) / n - mean * mean);
                errors(y, x)[c] = float(std::sqrt(variance / std::max(n - 1, 1.0)));
            }
    return errors;
}

cv::Mat1f Picture::noise_map(double exposure_stops) const
{
    CV_Assert(passes_ >= 2);
    const float first = float((passes_ + 1) / 2 * samples_per_pass), second = float(samples()) - first;
    // Two whole pictures have less noise than two halves. The difference in length of unequal halves
    // hardly matters.
    const double to_whole = std::sqrt(1 / double(samples()) / (.5 / double(first) + .5 / double(second)));
    cv::Mat1f noise(size_, 0.f);
    base::in_parallel(std::size_t(size_.height), 0, [&](std::size_t row) {
        const double height = (double(row) + .5) / size_.height;
        for (int x = 0; x < size_.width; ++x) {
            const PixelSums& pixel = sums(x, int(row));
            if (pixel.alpha <= 0)
                continue;
            const cv::Vec3f second_half = pixel.diffuse + pixel.specular - pixel.first_half;
            const double alpha = double(pixel.alpha) / samples();
            noise(int(row), x) =
                float(to_whole *
                      base::delta_e2000(encoded_lab(pixel.first_half, first, alpha, exposure_stops, height),
                                        encoded_lab(second_half, second, alpha, exposure_stops, height)));
        }
    });
    return noise;
}

double Picture::noise_de(double exposure_stops) const
{
    if (passes_ < 2)
        return std::numeric_limits<double>::infinity();
    const auto seen = std::ranges::count_if(sums_, [](const PixelSums& pixel) { return pixel.alpha > 0; });
    return seen > 0 ? cv::sum(noise_map(exposure_stops))[0] / double(seen) : 0;
}

} // namespace reference
