#include <cmath>

#include "base/smoothstep.hpp"
#include "wound/synthetic/synthetic_tissue.hpp"

namespace wound {
namespace {

/// 1 on the side of the border where the torn flap still hangs, 0 elsewhere.
float on_flap(const TissuePainter& painter, const Place& place)
{
    const float angle = vary(painter.seed(), 30, 0, 6.28f);
    const cv::Point2f to{std::cos(angle), std::sin(angle)};
    const float length = std::sqrt(place.p.dot(place.p)) + 1e-3f;
    return base::smoothstep(.35f, .75f, place.p.dot(to) / length + .2f * place.slow[Uneven]);
}

} // namespace

/// Tissue torn out down to the fat, about 22 mm, several lobes and a tear; a flap of skin with a curled edge
/// hangs on one side. Heals as the untreated facial wounds of Yang et al. 2016 (H3's defaults).
WoundKind avulsion()
{
    const auto shape = [](std::uint32_t seed, cv::Point2f p) {
        float f = ellipse(p, vary(seed, 0, 6.5f, 9.5f), vary(seed, 1, 5, 7.5f));
        const float first = vary(seed, 22, 0, 6.28f);
        for (int lobe = 0; lobe < 3; ++lobe) {
            const float angle = first + 2.1f * float(lobe) + vary(seed, 2 + lobe, 0, 1.4f);
            const cv::Point2f centre = turned({vary(seed, 6 + lobe, 3.5f, 8), 0}, angle);
            f = merge(f,
                      ellipse(turned(p - centre, -angle), vary(seed, 10 + lobe, 3, 5.5f),
                              vary(seed, 14 + lobe, 2, 4)),
                      3);
        }
        const float angle = vary(seed, 20, 0, 6.28f);
        const cv::Point2f tip = turned({vary(seed, 21, 9, 14), 2}, angle);
        return merge(f, tear(p, turned({4, 0}, angle), tip, 2.6f, .3f), 2);
    };
    const auto bed = [](const TissuePainter& painter, const Place& place) {
        const float flap = on_flap(painter, place);
        const float wall = 2.4f * (1 + .7f * place.slow[Wall]) * (1 - .5f * flap); // undercut below the flap
        const float fat = .52f + .9f * place.slow[Knobby];
        Tissue tissue = painter.cut(place, 2.06f + .05f * place.slow[Floor], wall, fat);
        painter.lay_fibrin(tissue, place);
        painter.lay_clot(tissue, place);
        tissue.reflectance *= 1 - .5f * flap * std::exp(-place.inside_mm / .8f);
        return tissue;
    };
    const auto beside = [](const TissuePainter& painter, Tissue& skin, const Place& place) {
        const float out = -place.inside_mm, flap = on_flap(painter, place);
        const float curl = (out - .9f - .3f * place.slow[Stretch]) / .75f, body = (out - 2) / 1.9f;
        skin.layer -= flap * (.55f * std::exp(-curl * curl) + .25f * std::exp(-body * body));
        // Its edge lacks blood, pale to livid, and turns the cut dermis outwards.
        const float edge = flap * base::smoothstep(2.8f, .2f, out);
        skin.reflectance = through(skin.reflectance, deoxygenated, .55f * edge * (1 + place.slow[Mottled]));
        const float cut = flap * base::smoothstep(.55f, .1f, out + .2f * place.slow[Mottled]);
        skin.reflectance = mix(skin.reflectance, through(pale_dermis, oxygenated, .5f), .8f * cut);
    };
    return {.name = "avulsion",
            .raggedness = .6f,
            .shape = shape,
            .bed = bed,
            .beside = beside,
            .clot = .16f,
            .fibrin = .1f,
            .inflamed = .8f,
            .swollen_mm = .22f,
            .smeared = .7f,
            .course = {{}, 30, .5, 1.2}};
}

} // namespace wound
