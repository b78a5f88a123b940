#include "base/color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace base {

namespace {

float encode(float linear)
{
    return linear_to_srgb(std::clamp(linear, 0.F, 1.F));
}

} // namespace

cv::Mat3f linear_from_srgb(const cv::Mat3b& srgb)
{
    static const std::array<float, 256> decoded = [] {
        std::array<float, 256> table{};
        for (int i = 0; i < 256; ++i)
            table[i] = srgb_to_linear(static_cast<float>(i) / 255);
        return table;
    }();
    cv::Mat3f linear(srgb.size());
    std::transform(srgb.begin(), srgb.end(), linear.begin(),
                   [](const cv::Vec3b& p) { return cv::Vec3f(decoded[p[0]], decoded[p[1]], decoded[p[2]]); });
    return linear;
}

cv::Mat3b srgb_from_linear(const cv::Mat3f& linear)
{
    cv::Mat3b srgb(linear.size());
    std::transform(linear.begin(), linear.end(), srgb.begin(), [](const cv::Vec3f& p) {
        const auto byte = [](float x) { return static_cast<uchar>(std::lround(255 * encode(x))); };
        return cv::Vec3b(byte(p[0]), byte(p[1]), byte(p[2]));
    });
    return srgb;
}

cv::Mat3f lab_from_linear(const cv::Mat3f& linear)
{
    // Not cv::cvtColor, which takes a tenth of a second to fill its tables on first use.
    cv::Mat3f lab(linear.size());
    std::transform(linear.begin(), linear.end(), lab.begin(), [](const cv::Vec3f& p) {
        const auto inside = [](float x) { return std::clamp(double(x), 0., 1.); };
        const Lab value = lab_from_linear(Color(inside(p[0]), inside(p[1]), inside(p[2])));
        return cv::Vec3f(float(value.l), float(value.a), float(value.b));
    });
    return lab;
}

} // namespace base
