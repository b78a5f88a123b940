#include "wound/synthetic/synthetic_tissue.hpp"

namespace wound {

/// Skin cut out with a knife: a clean ellipse about 26 x 11 mm with upright walls, down to the fat, left
/// open. Its course is our choice: by second intention, as the default curve, but cut clean and so a little
/// faster.
WoundKind excision()
{
    const auto shape = [](std::uint32_t seed, cv::Point2f p) {
        p = turned(p, vary(seed, 0, -.5f, .5f));
        const float length = vary(seed, 1, 11.5f, 14), width = vary(seed, 2, 4, 7.5f);
        // Two arcs that meet in a point, as a surgeon cuts, or more rounded.
        const float along = p.x / length, arcs = width * (1 - along * along) - std::abs(p.y);
        return std::lerp(arcs, ellipse(p, length, width), vary(seed, 3, 0, 1));
    };
    const auto bed = [](const TissuePainter& painter, const Place& place) {
        Tissue tissue =
            painter.cut(place, 2.05f + .02f * place.slow[Floor], 1.3f, .78f + .5f * place.slow[Knobby]);
        painter.lay_clot(tissue, place);
        return tissue;
    };
    return {.name = "excision",
            .raggedness = .12f,
            .shape = shape,
            .bed = bed,
            .clot = .06f,
            .inflamed = .5f,
            .swollen_mm = .12f,
            .smeared = .15f,
            .course = {{curve_through(8.5, 27)}, 30, .5, 1.2}};
}

} // namespace wound
