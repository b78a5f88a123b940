#include <cmath>

#include "wound/synthetic/kind.hpp"

namespace wound {

/// A gaping cut, about 34 x 7 mm, with a branch.
WoundKind laceration()
{
    const auto shape = [](std::uint32_t seed, cv::Point2f p) {
        p = turned(p, vary(seed, 0, -.15f, .25f));
        const float along = p.x / vary(seed, 1, 16, 18), bend = vary(seed, 2, -.014f, -.006f);
        const float half_width = vary(seed, 3, 2.4f, 3.2f) * (1 - along * along) * (1 + .3f * along);
        const float cut = half_width - std::abs(p.y - bend * p.x * p.x);
        const cv::Point2f from{vary(seed, 4, 1, 5), 0}, to{vary(seed, 5, 6, 9), vary(seed, 6, 5, 7)};
        return merge(cut, tear(p, from, to, 1.5f, .2f), 2);
    };
    return {.name = "laceration", .raggedness = .45f, .shape = shape};
}

} // namespace wound
