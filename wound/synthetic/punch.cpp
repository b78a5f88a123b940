#include "wound/synthetic/synthetic_tissue.hpp"

namespace wound {

/// The round hole of a punch, through the skin into the fat, with blood in it. A 6 mm punch left open closes
/// in about 16 days (our choice within the 2 to 4 weeks that are common for punches of 4 to 8 mm).
WoundKind punch()
{
    const auto shape = [](std::uint32_t seed, cv::Point2f p) {
        // The skin's tension draws the circle out a little.
        const float radius = vary(seed, 0, 6.5f, 7.5f), drawn = vary(seed, 1, 1, 1.28f);
        return ellipse(turned(p, vary(seed, 2, 0, 3.14f)), radius * drawn, radius / drawn);
    };
    const auto bed = [](const TissuePainter& painter, const Place& place) {
        Tissue tissue =
            painter.cut(place, 2.1f + .03f * place.slow[Floor], 1.4f, .3f + .6f * place.slow[Knobby]);
        painter.lay_clot(tissue, place);
        return tissue;
    };
    return {.name = "punch",
            .raggedness = .07f,
            .shape = shape,
            .bed = bed,
            .clot = .5f,
            .inflamed = .55f,
            .swollen_mm = .12f,
            .smeared = .2f,
            .course = {{curve_through(6, 16)}, 6, .5, 1.1}};
}

} // namespace wound
