#include "wound/optics/surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/shared/shading.h"

namespace optics {

// J. Jimenez, X. Wu, A. Pesce & A. Jarabo 2016, "Practical Real-Time Strategies for Accurate Indirect
// Occlusion".
base::Color visibility(double open, const base::Color& albedo)
{
    base::Color result;
    for (int c = 0; c < 3; ++c) {
        const double a = 2.0404 * albedo[c] - .3324, b = -4.7951 * albedo[c] + .6417,
                     first = 2.7552 * albedo[c] + .6903;
        result[c] = std::max(open, ((open * a + b) * open + first) * open);
    }
    return result;
}

// The skin around a point faces anywhere, so on average a half of it faces the lamp, by half; it is more where the point
// faces the lamp. The share is fitted to path-traced pictures.
double bounced_share(double open, double cosine)
{
    return shared::BOUNCED_SHARE * (1 - open) * (.5 + .5 * cosine);
}

double specular_occlusion(double open, double cosine)
{
    return std::pow(std::clamp(cosine, 1e-3, 1.), 2 * (1 - open) / std::max(open, 1e-3));
}

double above_horizon(double cosine)
{
    return std::pow(std::clamp(1 + 1.3 * cosine, 0., 1.), 2);
}

} // namespace optics
