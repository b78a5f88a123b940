#include <cmath>

#include "wound/synthetic/synthetic_tissue.hpp"

namespace wound {

/// A torn cut, about 34 x 7 mm, often with a branch: lips that gape, through the dermis into the fat. Closes
/// in 10 to 14 days, as a facial cut whose lips are drawn together (our choice within the time after which
/// its sutures come out, 5 to 7 days, and that of a firm line, 2 weeks).
WoundKind laceration()
{
    const auto shape = [](std::uint32_t seed, cv::Point2f p) {
        p = turned(p, vary(seed, 0, -.3f, .35f));
        const float along = p.x / vary(seed, 1, 15, 18), bend = vary(seed, 2, -.02f, .02f);
        const float zigzag =
            vary(seed, 7, 0, .9f) * std::sin(p.x * vary(seed, 8, .35f, .8f) + vary(seed, 9, 0, 6));
        const float half_width =
            vary(seed, 3, 2.1f, 3.4f) * (1 - along * along) * (1 + vary(seed, 10, -.4f, .4f) * along);
        const float cut = half_width - std::abs(p.y - bend * p.x * p.x - zigzag);
        const float side = vary(seed, 11, 0, 1) < .5f ? -1.f : 1.f, branch = vary(seed, 12, 0, 1);
        if (branch < .35f)
            return cut; // no branch
        const cv::Point2f from{vary(seed, 4, -7, 5), 0},
            to = from + cv::Point2f(vary(seed, 5, 2, 6), side * vary(seed, 6, 4, 7));
        return merge(cut, tear(p, from, to, 1.4f, .2f), 2);
    };
    const auto bed = [](const TissuePainter& painter, const Place& place) {
        const float gape = 1.7f * (1 + .5f * place.slow[Wall]);
        Tissue tissue = painter.cut(place, 2.11f + .05f * place.slow[Floor], gape, .4f);
        painter.lay_clot(tissue, place);
        return tissue;
    };
    return {.name = "laceration",
            .raggedness = .4f,
            .shape = shape,
            .bed = bed,
            .clot = .35f,
            .inflamed = .7f,
            .swollen_mm = .2f,
            .smeared = .5f,
            .course = {{curve_through(5, 12), HealingModel::Face, .2}, 30, .2, 1.1}};
}

} // namespace wound
