#include "base/smoothstep.hpp"
#include "wound/synthetic/synthetic_tissue.hpp"

namespace wound {

/// A burn of partial thickness: epidermis gone, moist mottled dermis with paler, deeper patches, whitish
/// shreds of blister roofs at the border and a wide red halo. Such burns close within 10 to 21 days from the
/// hair follicles; ours in 16 (our choice).
WoundKind burn()
{
    const auto shape = [](std::uint32_t seed, cv::Point2f p) {
        float f = ellipse(p, vary(seed, 0, 7, 10), vary(seed, 1, 5.5f, 8));
        for (int patch = 0; patch < 4; ++patch) {
            const cv::Point2f centre{vary(seed, 2 + patch, -9, 9), vary(seed, 8 + patch, -7, 7)};
            f = merge(
                f, ellipse(p - centre, vary(seed, 14 + patch, 2.5f, 5.5f), vary(seed, 20 + patch, 2.5f, 5)),
                3);
        }
        return f;
    };
    const auto bed = [](const TissuePainter& painter, const Place& place) {
        const cv::Point2f p = place.p;
        const float mottle = painter.noise(p, .55f, 80, 4), fine = painter.noise(p, 2.2f, 81, 3);
        Tissue tissue;
        const float pale = base::smoothstep(.05f, .5f, place.slow[Supply] + .25f * mottle);
        const float blood = std::max(1.9f + 1.1f * mottle + .35f * fine - 1.2f * pale, .3f);
        tissue.reflectance = through(mix(pale_dermis, {.80f, .66f, .50f}, pale), oxygenated, blood);
        tissue.layer = base::smoothstep(-.2f, 1.0f, place.inside_mm) * (1.02f + .05f * pale + .02f * mottle);
        tissue.wetness = .75f;
        raise(tissue, .05f * fine);
        // Shreds of the blister's roof, more of them near the border.
        const float over =
            painter.noise(p, .3f, 82, 4) + .9f * base::smoothstep(4.5f, 0, place.inside_mm) - .78f;
        const float sheet = base::smoothstep(-.06f, .16f, over),
                    curl = sheet * base::smoothstep(.3f, .08f, over);
        const cv::Vec3f roof = mix(painter.skin(place).reflectance, {.74f, .64f, .50f}, .55f);
        tissue.reflectance =
            mix(tissue.reflectance, roof * (1 + .12f * mottle), sheet * (.42f + .25f * curl));
        tissue.layer -= .45f * sheet * tissue.layer;
        raise(tissue, .22f * curl + .06f * sheet * mottle);
        tissue.wetness *= 1 - .75f * sheet;
        return tissue;
    };
    Healing healing{curve_through(7, 16), HealingModel::Face, .9};
    healing.age_days = 3; // a burn does not bleed
    return {.name = "burn",
            .raggedness = .8f,
            .shape = shape,
            .bed = bed,
            .inflamed = .95f,
            .swollen_mm = .12f,
            .course = {healing, 30, .25}};
}

} // namespace wound
