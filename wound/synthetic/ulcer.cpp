#include <cmath>

#include "base/smoothstep.hpp"
#include "wound/synthetic/synthetic_tissue.hpp"

namespace wound {

/// A chronic ulcer, about 24 mm: granulation under yellow slough, a rolled, macerated edge in livid skin.
/// Closes in 12 weeks, a usual time of venous leg ulcers under treatment, of which we know no facial
/// counterpart.
WoundKind ulcer()
{
    const auto shape = [](std::uint32_t seed, cv::Point2f p) {
        p = turned(p, vary(seed, 0, 0, 3.14f));
        const float oval = ellipse(p, vary(seed, 1, 9, 12), vary(seed, 2, 6.5f, 9));
        const cv::Point2f centre{vary(seed, 3, -8, 8), vary(seed, 4, -5, 5)};
        return merge(oval, ellipse(p - centre, vary(seed, 5, 3, 6), vary(seed, 6, 3, 6)), 5);
    };
    const auto bed = [](const TissuePainter& painter, const Place& place) {
        Tissue tissue = painter.granulation(place);
        const float wall = 2.2f * (1 + .7f * place.slow[Wall]);
        const float floor = 1.85f + .12f * place.slow[Floor];
        tissue.layer += floor * base::smoothstep(-.3f, std::max(wall, .8f), place.inside_mm);
        painter.lay_fibrin(tissue, place);
        // New skin creeps in from the edge, a thin pink to white film.
        const float film = base::smoothstep(1.3f, .1f, place.inside_mm + .7f * place.slow[BendX]);
        tissue.reflectance = mix(tissue.reflectance, {.66f, .36f, .32f}, .6f * film);
        return tissue;
    };
    const auto beside = [](const TissuePainter& painter, Tissue& skin, const Place& place) {
        const float out = -place.inside_mm;
        const float roll = (out - .7f) / .75f,
                    rolled =
                        std::exp(-roll * roll) * std::clamp(.6f + 2.2f * place.slow[Stretch], .05f, 1.2f);
        skin.layer -= .13f * rolled;
        skin.reflectance =
            mix(skin.reflectance, {.76f, .55f, .49f},
                std::clamp(.22f * rolled * (1 + painter.noise(place.p, .8f, 91, 3)), 0.f, 1.f)); // macerated
        const float stained = base::smoothstep(9, 1.5f, out) * base::smoothstep(.6f, 2, out) *
                              std::max(.8f + place.slow[Uneven], 0.f);
        skin.reflectance = through(skin.reflectance, deoxygenated, .45f * stained);
        const float scales =
            base::smoothstep(.2f, .5f, painter.noise(place.p, .9f, 90, 3)) * base::smoothstep(6, 1, out);
        skin.reflectance = mix(skin.reflectance, {.72f, .62f, .54f}, .3f * scales);
    };
    Healing healing{curve_through(28, 84), HealingModel::Face, .5};
    healing.age_days = 5; // its bleeding is over and its slough still there
    return {.name = "ulcer",
            .raggedness = .65f,
            .shape = shape,
            .bed = bed,
            .beside = beside,
            .fibrin = .42f,
            .inflamed = .55f,
            .swollen_mm = 0,
            .course = {healing, 30, .5, 1.2}};
}

} // namespace wound
