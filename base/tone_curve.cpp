#include "base/tone_curve.hpp"

#include <algorithm>
#include <cmath>

namespace base {

Color soft_shoulder(const Color& linear)
{
    constexpr double knee = 0.8;
    Color curved;
    for (int c = 0; c < 3; ++c) {
        const double over = std::max(linear[c] - knee, 0.0) / (1 - knee);
        curved[c] = std::min(linear[c], knee) + (1 - knee) * over / (1 + over);
    }
    return curved;
}

Color on_backdrop(const Color& radiance, double alpha, double exposure_stops, double height)
{
    Color picture = soft_shoulder(std::exp2(exposure_stops) * radiance);
    for (int c = 0; c < 3; ++c)
        picture[c] += (1 - std::clamp(alpha, 0.0, 1.0)) *
                      std::lerp(double(backdrop_top[c]), double(backdrop_bottom[c]), height);
    return picture;
}

Lab shown_lab(const Color& radiance, double alpha, double exposure_stops, double height)
{
    Color shown = on_backdrop(radiance, alpha, exposure_stops, height);
    for (double& channel : shown.val)
        channel = std::clamp(channel, 0.0, 1.0);
    return lab_from_linear(shown);
}

cv::Mat3b encode_picture(const cv::Mat4f& radiance, double exposure_stops)
{
    cv::Mat3b encoded(radiance.size());
    for (int y = 0; y < radiance.rows; ++y)
        for (int x = 0; x < radiance.cols; ++x) {
            const cv::Vec4f& seen = radiance(y, x);
            encoded(y, x) = srgb8_from_linear(
                on_backdrop({seen[0], seen[1], seen[2]}, seen[3], exposure_stops, (y + .5) / radiance.rows));
        }
    return encoded;
}

} // namespace base
