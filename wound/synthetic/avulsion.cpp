#include "wound/synthetic/kind.hpp"

namespace wound {

/// Several lobes and a tear, about 21 mm.
WoundKind avulsion()
{
    const auto shape = [](std::uint32_t seed, cv::Point2f p) {
        float f = ellipse(p, vary(seed, 0, 7, 8.5f), vary(seed, 1, 5.5f, 7));
        for (int lobe = 0; lobe < 3; ++lobe) {
            const float angle = 2.1f * float(lobe) + vary(seed, 2 + lobe, 0, 1.4f);
            const cv::Point2f centre = turned({vary(seed, 6 + lobe, 4.5f, 7.5f), 0}, angle);
            f = merge(f,
                      ellipse(turned(p - centre, -angle), vary(seed, 10 + lobe, 3, 5),
                              vary(seed, 14 + lobe, 2, 3.5f)),
                      3);
        }
        const float angle = vary(seed, 20, 0, 6.28f);
        const cv::Point2f tip = turned({vary(seed, 21, 11, 13), 2}, angle);
        return merge(f, tear(p, turned({4, 0}, angle), tip, 2.6f, .3f), 2);
    };
    return {.name = "avulsion", .raggedness = 1, .shape = shape};
}

} // namespace wound
