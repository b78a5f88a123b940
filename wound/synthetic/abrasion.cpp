#include <cmath>

#include "base/smoothstep.hpp"
#include "wound/synthetic/synthetic_tissue.hpp"

namespace wound {
namespace {

/// How deep the skin is scraped, 0 not at all .. 1: streaks along the scrape, islands of skin between them,
/// and no wall: the scrape runs out towards the border.
float scraped(const TissuePainter& painter, const Place& place)
{
    const float streak = painter.streaks(place), broken = painter.noise(place.p, .45f, 21, 3);
    const float runs_out = base::smoothstep(-.6f, 1.8f, place.inside_mm + .9f * streak);
    const float island = base::smoothstep(.16f, .42f, painter.noise(place.p, .22f, 24, 3) - .3f * streak);
    return std::clamp(.62f + .5f * streak + .35f * broken, 0.f, 1.f) * runs_out * (1 - .95f * island);
}

void scrape(const TissuePainter& painter, Tissue& skin, const Place& place, float deep)
{
    const float fine = painter.noise(place.p, 1.6f, 22, 3);
    const float raw = base::smoothstep(.12f, .6f, deep + .15f * fine);
    skin.reflectance = through(skin.reflectance, oxygenated, .5f * base::smoothstep(0, .2f, deep));
    const float blood = std::max(.75f + 2.1f * deep * deep + .6f * fine, .3f);
    skin.reflectance = mix(skin.reflectance, through(pale_dermis, oxygenated, blood), raw);
    skin.wetness = std::max(skin.wetness, .55f * raw);
    skin.layer = 1.12f * deep;
    // Bleeding points: the tips of the papillae that the scrape has cut.
    const Cell point = cell_at(painter.seed() + 5, place.p * 1.15f);
    const float size = .13f + .16f * hash01(point.id, 1, 1);
    const float bleeds = base::smoothstep(size + .1f, size - .05f, point.nearest) *
                         base::smoothstep(.5f, .75f, deep + .35f * (hash01(point.id, 2, 1) - .5f));
    skin.reflectance = mix(skin.reflectance, {.17f, .016f, .013f}, .85f * bleeds);
    raise(skin, .1f * bleeds);
    // Dried serum and blood, honey to brown.
    const float crust = base::smoothstep(.15f, .6f, painter.noise(place.p, .5f, 23, 3) + .3f * fine) * raw;
    skin.reflectance =
        mix(skin.reflectance, mix(cv::Vec3f(.36f, .16f, .055f), cv::Vec3f(.12f, .032f, .018f), deep),
            .5f * crust);
    raise(skin, .06f * crust);
    skin.wetness *= 1 - .7f * crust;
}

} // namespace

/// Skin rubbed off: about 30 x 18 mm, .1 to .4 mm deep. Closes from the hair follicles, not from its border,
/// so its size hardly matters: 8 to 12 days (common clinical range of partial-thickness facial grazes).
WoundKind abrasion()
{
    const auto shape = [](std::uint32_t seed, cv::Point2f p) {
        p = turned(p, scrape_angle(seed));
        const float length = vary(seed, 1, 11, 15), width = vary(seed, 2, 6, 9.5f);
        const float oval = ellipse(p, length, width);
        const cv::Point2f centre{vary(seed, 3, -8, 8), vary(seed, 4, -6, 6)};
        const float lobe = ellipse(p - centre, vary(seed, 7, 4, 8), vary(seed, 8, 2.5f, 5));
        const cv::Point2f tip{vary(seed, 5, 12, 15.5f), vary(seed, 6, -6, 6)};
        return merge(merge(oval, lobe, 4), tear(p, {4, tip.y / 2}, tip, 4, 1.3f), 4);
    };
    const auto bed = [](const TissuePainter& painter, const Place& place) {
        Tissue tissue = painter.skin(place);
        tissue.reflectance =
            through(tissue.reflectance, oxygenated, .42f); // as inflamed as the skin beside it
        scrape(painter, tissue, place, scraped(painter, place));
        return tissue;
    };
    const auto beside = [](const TissuePainter& painter, Tissue& skin, const Place& place) {
        const float near = base::smoothstep(-4.f, -.1f, place.inside_mm);
        const float streak = painter.streaks(place);
        const float deep = .4f * near * base::smoothstep(.2f, .75f, streak - .5f * (1 - near));
        if (deep > .01f) {
            const float layer = skin.layer;
            scrape(painter, skin, place, deep);
            skin.layer += layer;
        }
    };
    return {.name = "abrasion",
            .raggedness = .8f,
            .shape = shape,
            .bed = bed,
            .beside = beside,
            .inflamed = .55f,
            .swollen_mm = .05f,
            .smeared = .3f,
            .course = {{curve_through(4.5, 10), HealingModel::Face, .85}, 30, .2}};
}

} // namespace wound
