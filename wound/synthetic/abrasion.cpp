#include "wound/synthetic/kind.hpp"

namespace wound {

/// A ragged oval, about 27 x 19 mm.
WoundKind abrasion()
{
    const auto shape = [](std::uint32_t seed, cv::Point2f p) {
        p = turned(p, vary(seed, 0, .2f, .6f));
        const float oval = ellipse(p, vary(seed, 1, 11.5f, 12.5f), vary(seed, 2, 7.8f, 9));
        const cv::Point2f centre{vary(seed, 3, -9, -6), vary(seed, 4, 3, 6)};
        const float lobe = ellipse(turned(p - centre, .5f), 5.5f, 3.6f);
        const cv::Point2f tip{vary(seed, 5, 13, 15), vary(seed, 6, -7, -4)};
        return merge(merge(oval, lobe, 4), tear(p, {8, -3}, tip, 3.2f, .4f), 3);
    };
    return {.name = "abrasion", .raggedness = 1, .shape = shape};
}

} // namespace wound
