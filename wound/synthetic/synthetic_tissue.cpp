#include "wound/synthetic/synthetic_tissue.hpp"

#include <algorithm>
#include <cmath>

#include "base/color.hpp"
#include "base/smoothstep.hpp"

namespace wound {
namespace {

using cv::Point2f;
using cv::Vec3f;

// Absorbance of one unit of blood per channel: haemoglobin absorbs green and blue and almost no red; without
// oxygen, or dried to methaemoglobin, it absorbs more red. Shapes after Prahl's haemoglobin tables averaged
// over the sRGB primaries.
const Vec3f oxygenated{.16f, 1.f, .90f}, deoxygenated{.38f, 1.f, .82f}, dried{.80f, 1.05f, .95f};
constexpr float reach_mm = 12; // the injury is visible up to this distance from the open bed
const Vec3f pale_dermis{.74f, .53f, .43f};

Vec3f mix(const Vec3f& a, const Vec3f& b, float t)
{
    return a + (b - a) * t;
}

/// Fast exp(-x): within 1 % for x in -1..2, slightly too large beyond, where the value is small.
float transmitted(float x)
{
    x *= .25f;
    const float inverse = 1 + x * (1 + x * (.5f + x * .1667f)), squared = inverse * inverse;
    return 1 / (squared * squared);
}

/// Reflectance of `base` under `amount` units of blood.
Vec3f through(const Vec3f& base, const Vec3f& blood, float amount)
{
    return {base[0] * transmitted(amount * blood[0]), base[1] * transmitted(amount * blood[1]),
            base[2] * transmitted(amount * blood[2])};
}

float fraction(std::uint32_t bits)
{
    return float(bits >> 8) * 0x1p-24f;
}

/// The value that is exceeded by `share` of the values.
float upper_quantile(std::vector<float> values, float share)
{
    if (values.empty() || share <= 0)
        return 1e3f;
    const auto index =
        std::min(values.size() - 1, std::size_t((1 - std::min(share, 1.f)) * float(values.size())));
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(index), values.end());
    return values[index];
}

} // namespace

TissuePainter::TissuePainter(const SyntheticWound& wound, const Noise& noise) : wound_(wound), noise_(noise)
{
    for (int channel = 0; channel < 3; ++channel)
        skin_[channel] = base::srgb_to_linear(float(wound.skin[channel]) / 255);
    for (int channel = 0; channel < int(turns_.size()); ++channel)
        turns_[channel] = {std::cos(2.4f * float(channel)),
                           std::sin(2.4f * float(channel))}; // the golden angle, radians
    const float angle = float(2 * CV_PI) * hash01(wound.seed, 1, 2);
    scrape_direction_ = {std::cos(angle), std::sin(angle)};
    scrape_centre_ = 10.f * scrape_direction_;
}

Point2f TissuePainter::channel_position(Point2f p, float per_mm, int channel) const
{
    const Point2f turn = turns_[channel] * per_mm;
    return {turn.x * p.x - turn.y * p.y + 3.71f * float(channel),
            turn.y * p.x + turn.x * p.y + 7.13f * float(channel)};
}

float TissuePainter::noise(Point2f p, float per_mm, int channel, int octaves) const
{
    return noise_.sum(channel_position(p, per_mm, channel), octaves, .55f);
}

SlowFields TissuePainter::slow_fields(Point2f p, float inside_mm) const
{
    SlowFields slow = SlowFields::all(0);
    slow[Blotches] = noise(p, .12f, 1, 3);
    if (inside_mm < -reach_mm)
        return slow;
    slow[Uneven] = noise(p, .13f, 10, 2);
    slow[Mottled] = noise(p, .5f, 11, 2);
    slow[Bruise] = noise(p, .17f, 12);
    const Point2f away = p - scrape_centre_;
    slow[Scraped] = 1 - std::sqrt(away.dot(away)) / 9.f + .7f * noise(p, .16f, 20, 2);
    slow[Wiped] = noise(Point2f(p.x + 2 * noise(p, .22f, 30, 2), .4f * p.y), .24f, 31, 3);
    slow[FilmPatches] = noise(p, .33f, 35, 2);
    slow[Stretch] = noise(p, .13f, 40, 2);
    slow[BendX] = noise(p, .45f, 50, 2);
    slow[BendY] = noise(p, .45f, 51, 2);
    if (inside_mm < -2)
        return slow;
    slow[Supply] = noise(p, .11f, 52, 4);
    slow[Livid] = noise(p, .16f, 53, 2);
    slow[Wall] = noise(p, .2f, 55);
    slow[Floor] = noise(p, .09f, 56, 2);
    slow[Knobby] = noise(p, .14f, 57, 2);
    slow[Fibrin] = noise(p + 1.2f * Point2f(noise(p, .3f, 60), noise(p, .3f, 61)), .15f, 62, 3) +
                   .25f * base::smoothstep(.3f, 2.5f, inside_mm);
    slow[Clot] = noise(p + Point2f(noise(p, .35f, 70), noise(p, .35f, 71)), .17f, 72, 3) +
                 .45f * std::exp(-std::max(inside_mm, 0.f) / 1.3f);
    return slow;
}

void TissuePainter::set_shares(const std::vector<SlowFields>& bed)
{
    std::vector<float> fibrin_values, clot_values;
    for (const SlowFields& slow : bed) {
        fibrin_values.push_back(slow[Fibrin]);
        clot_values.push_back(slow[Clot]);
    }
    fibrin_threshold_ = upper_quantile(std::move(fibrin_values), wound_.fibrin);
    clot_threshold_ = upper_quantile(std::move(clot_values), wound_.clot);
}

Tissue TissuePainter::at(const Place& place) const
{
    if (place.inside_mm > 0) {
        Tissue tissue = bed(place);
        fray_border(tissue, place);
        return tissue;
    }
    Tissue tissue = skin(place);
    if (place.inside_mm > -reach_mm) {
        inflame(tissue, place);
        scrape(tissue, place);
        smear_blood(tissue, place);
        fray_border(tissue, place);
    }
    return tissue;
}

/// Healthy skin: blotches of blood, and pores.
Tissue TissuePainter::skin(const Place& place) const
{
    const float grain = noise(place.p, 1.0f, 2, 2);
    Tissue tissue;
    tissue.reflectance =
        through(skin_, oxygenated, .13f * place.slow[Blotches] + .06f * grain) * (1 + .03f * grain);
    tissue.height_mm = .01f * grain;
    return tissue;
}

/// The swollen, reddened halo; its width is uneven and it is mottled, as vessels are.
void TissuePainter::inflame(Tissue& tissue, const Place& place) const
{
    const float out = -place.inside_mm;
    const float spread = place.slow[Uneven], mottle = place.slow[Mottled];
    const float width = std::max(2.4f * (1 + 1.1f * spread), .9f);
    const float near = std::exp(-std::pow(out / width, 1.25f));
    const float far =
        std::exp(-out / 5.5f) * std::max(1 + 1.3f * spread, .2f) * (1 - base::smoothstep(7, reach_mm, out));
    const float tight = (out - 1.1f - .8f * mottle) / .55f; // near 0, swelling squeezes the blood out
    const float blanched = 1 - .45f * std::exp(-tight * tight);
    const float amount =
        near * std::max(.72f + .55f * mottle, .1f) * blanched + .26f * far * std::max(1 + .8f * mottle, 0.f);
    const float bruised = near * base::smoothstep(.0f, .5f, place.slow[Bruise]);
    tissue.reflectance = through(tissue.reflectance, mix(oxygenated, deoxygenated, .8f * bruised), amount);
    const float swelling = (out - 1.3f) / 1.5f;
    tissue.height_mm = tissue.height_mm * (1 - .6f * near) + .45f * std::exp(-swelling * swelling);
    tissue.wetness = .25f * near;
}

/// Streaks of scraped skin with bleeding points and thin crusts.
void TissuePainter::scrape(Tissue& tissue, const Place& place) const
{
    const float region = base::smoothstep(.05f, .7f, place.slow[Scraped]);
    if (region <= 0 || place.inside_mm > -.1f)
        return;
    const Point2f p = place.p + .5f * Point2f(place.slow[BendX], place.slow[BendY]);
    const Point2f along{p.dot(scrape_direction_), p.x * scrape_direction_.y - p.y * scrape_direction_.x};
    const float streak = .6f * noise_.at({along.x * .07f + 5, along.y * .8f}) +
                         .8f * noise_.at({along.x * .16f + 5, along.y * 1.9f}) +
                         .5f * noise_.at({along.x * .4f + 9, along.y * 4.1f});
    const float broken = noise(place.p, .6f, 21, 3);
    const float raw = region * base::smoothstep(.0f, .75f, streak + .6f * broken + .12f);
    const float points =
        base::smoothstep(.25f, .6f, noise(place.p, 1.5f, 22, 2)) * base::smoothstep(.3f, .8f, raw);
    const float crust = base::smoothstep(.6f, .95f, streak + .8f * noise(place.p, 1.1f, 23)) *
                        base::smoothstep(.3f, .8f, raw);
    tissue.reflectance =
        through(tissue.reflectance, oxygenated, .7f * raw * (.7f + .6f * broken) + .9f * points);
    tissue.reflectance = mix(tissue.reflectance, Vec3f(.15f, .042f, .022f), .65f * crust);
    tissue.height_mm += .2f * crust - .08f * raw;
    tissue.wetness = std::max(tissue.wetness, .4f * raw);
}

/// Films of blood that ran or were wiped, and spatter.
void TissuePainter::smear_blood(Tissue& tissue, const Place& place) const
{
    const Point2f p = place.p;
    const float out = -place.inside_mm;
    const float wipe = place.slow[Wiped] + .35f * place.slow[FilmPatches] - .04f * out;
    if (wipe > .05f) {
        const float film = base::smoothstep(.05f, .5f, wipe) *
                           std::max(.5f + 1.2f * noise(p, .9f, 32, 3), 0.f) *
                           (1 - base::smoothstep(4, 9, out));
        tissue.reflectance = through(tissue.reflectance, mix(oxygenated, dried, .3f), .9f * film);
    }
    const float splashed = .6f * place.slow[FilmPatches] - .035f * out;
    if (splashed < -.1f)
        return; // the noise below cannot reach the threshold
    const float speck = base::smoothstep(.54f, .66f, noise(p, .8f, 33, 3) + splashed);
    tissue.reflectance = mix(tissue.reflectance, Vec3f(.15f, .026f, .017f), .75f * speck);
    tissue.height_mm += .2f * speck;
}

/// The wound's lip: stretches of dried blood, flakes of dead epidermis, the cut edge of the dermis, and the
/// dark line under it.
void TissuePainter::fray_border(Tissue& tissue, const Place& place) const
{
    const Point2f p = place.p;
    const float d = place.inside_mm;
    if (std::abs(d) > 3)
        return;
    const float along = place.slow[Stretch], fine = noise(p, .9f, 41, 3);
    // The edge is a band of exposed, bleeding dermis from the lip down the wall.
    const float reach = .75f + 1.1f * place.slow[Uneven] + .5f * fine;
    const float bared = base::smoothstep(std::max(reach, .1f), 0, std::abs(d)) *
                        base::smoothstep(-.35f, .25f, place.slow[Knobby] + .5f * fine);
    tissue.reflectance =
        mix(tissue.reflectance, through(pale_dermis, mix(oxygenated, deoxygenated, .15f), 2.0f + 1.6f * fine),
            .85f * bared);
    if (d > 0) {
        const float shadow = std::exp(-d / .6f) * std::clamp(.45f - .4f * place.facing_light, 0.f, 1.f);
        const float lip = base::smoothstep(.7f, .1f, d + .3f * fine) *
                          base::smoothstep(-.1f, .6f, place.facing_light + along);
        tissue.reflectance =
            mix(tissue.reflectance, through(pale_dermis, oxygenated, 1.f + .6f * fine), .6f * lip);
        tissue.reflectance *= 1 - .4f * shadow;
    } else {
        const float flakes =
            base::smoothstep(.05f, .5f, fine - .9f * along) * base::smoothstep(-1.6f, -.3f, d);
        tissue.reflectance = mix(tissue.reflectance, Vec3f(.62f, .45f, .36f), .35f * flakes);
        tissue.height_mm += .1f * flakes;
    }
    const float half_width = 1.3f * std::max(along - .10f, 0.f) + .25f * std::max(fine, 0.f);
    const float ragged = std::abs(d + .15f) - half_width + .8f * fine;
    const float here = base::smoothstep(-.12f, .2f, along);
    const float stain = base::smoothstep(1.3f, -.2f, ragged) * here,
                crust = base::smoothstep(.35f, -.35f, ragged) * here;
    const float lumps = noise(p, 1.1f, 42, 3);
    tissue.reflectance = through(tissue.reflectance, mix(oxygenated, dried, .35f), 1.0f * stain);
    const Vec3f colour =
        mix(Vec3f(.036f, .012f, .010f), Vec3f(.17f, .036f, .020f), std::clamp(.35f + .9f * lumps, 0.f, 1.f));
    tissue.reflectance = mix(tissue.reflectance, colour, .72f * crust);
    tissue.height_mm += .3f * crust * (1 + 1.2f * lumps);
    tissue.wetness *= 1 - .8f * crust;
}

/// Granulating dermis: knobs of young vessels in pale tissue, darker clefts between them; livid where oxygen
/// is low.
Tissue TissuePainter::bed(const Place& place) const
{
    const Point2f p = place.p + .7f * Point2f(place.slow[BendX], place.slow[BendY]);
    const Cell coarse = cell_at(wound_.seed + 1, p * .7f), fine = cell_at(wound_.seed + 2, p * 1.9f);
    const float knobs = base::smoothstep(-.35f, .35f, place.slow[Knobby]);
    const float dome = 1 - .75f * (coarse.nearest * coarse.nearest + fine.nearest * fine.nearest);
    const float rough = noise(p, 1.1f, 54, 4);
    const float bump =
        std::clamp(std::lerp(.55f + .8f * rough, dome + .4f * rough, .4f + .45f * knobs), 0.f, 1.f);
    const float patches = noise(p, .42f, 58, 3),
                short_of_oxygen = base::smoothstep(-.05f, .5f, place.slow[Livid]);

    Tissue tissue;
    const float own = fraction(coarse.id * 2654435761u) - .5f;
    const float blood = std::clamp(3.0f + 1.7f * place.slow[Supply] + 1.0f * patches + .35f * own * knobs +
                                       2.0f * (.60f - bump) + .9f * std::exp(-place.inside_mm / 1.2f),
                                   1.1f, 5.5f);
    tissue.reflectance = through(pale_dermis, mix(oxygenated, deoxygenated, .75f * short_of_oxygen), blood) *
                         (.77f + .22f * bump);

    const float wall_mm = 1.2f + .8f * place.slow[Wall];
    const float floor_mm = 1.9f + .7f * place.slow[Floor];
    tissue.height_mm =
        -floor_mm * base::smoothstep(-.1f, std::max(wall_mm, .4f), place.inside_mm) + .18f * bump;
    tissue.wetness = .9f * base::smoothstep(.2f, .8f, place.inside_mm);
    lay_fibrin(tissue, place, bump);
    lay_clot(tissue, place);
    return tissue;
}

/// Yellow slough: a translucent film that fills the clefts before it covers the knobs; a few strands at its
/// margin.
void TissuePainter::lay_fibrin(Tissue& tissue, const Place& place, float bump) const
{
    const float over = place.slow[Fibrin] - fibrin_threshold_;
    if (over < -.45f)
        return;
    const Point2f p = place.p;
    const float mottle = noise(p, .75f, 64, 3), curl = noise(p, .3f, 63, 2);
    const float lines =
        1 - std::abs(noise_.at({.13f * p.x + .34f * p.y + .5f * curl, .24f * p.y - .10f * p.x + 40}));
    const float strand = base::smoothstep(.91f, .99f, lines) * base::smoothstep(-.40f, -.05f, over) *
                         std::clamp(.5f + 1.5f * mottle, 0.f, 1.f);
    const float sheet = base::smoothstep(-.16f, .26f, over + .42f * (.55f - bump) + .30f * mottle);
    const float thickness = std::clamp(.30f + 1.1f * over + .9f * mottle, 0.f, 1.f);
    const Vec3f colour =
        mix(Vec3f(.40f, .20f, .075f), Vec3f(.56f, .38f, .19f), thickness) * (1 + .10f * noise(p, 1.8f, 66));
    const float cover = std::max(sheet * (.36f + .44f * thickness), .5f * strand);
    tissue.reflectance = mix(tissue.reflectance, colour, cover);
    tissue.height_mm += cover * (.18f - .20f * bump + .12f * thickness);
}

/// Clotted blood: brown-black, lumpy and partly cracked where thick, with a translucent dark red film around
/// it.
void TissuePainter::lay_clot(Tissue& tissue, const Place& place) const
{
    const Point2f p = place.p;
    const float lumps = noise(p, .7f, 74, 3);
    const float over = place.slow[Clot] - clot_threshold_ + .22f * noise(p, .5f, 73, 4);
    if (over < -.30f)
        return;
    const float film = base::smoothstep(-.30f, .08f, over), body = base::smoothstep(-.03f, .17f, over),
                thickness = base::smoothstep(.0f, .5f, over + .4f * lumps);
    tissue.reflectance = through(tissue.reflectance, mix(deoxygenated, dried, .6f * film), 1.5f * film);
    const Vec3f colour =
        mix(Vec3f(.125f, .018f, .013f), Vec3f(.026f, .0085f, .0075f), thickness) * (1 + .55f * lumps);
    const float crack = base::smoothstep(.94f, .99f, 1 - std::abs(noise(p, .4f, 75, 2))) *
                        base::smoothstep(.1f, .4f, thickness);
    tissue.reflectance = mix(tissue.reflectance, colour, .92f * body * (1 - .6f * crack));
    tissue.height_mm += body * (.45f * thickness + .35f * lumps - .25f * crack);
    tissue.wetness = std::lerp(tissue.wetness, .8f, body);
}

} // namespace wound
