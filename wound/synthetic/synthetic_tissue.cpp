#include "wound/synthetic/synthetic_tissue.hpp"

#include <algorithm>
#include <cmath>

#include "base/color.hpp"
#include "base/smoothstep.hpp"

namespace wound {
namespace {

using cv::Point2f;
using cv::Vec3f;

constexpr float reach_mm = 12; // the injury is visible up to this distance from the open bed

/// Fast exp(-x): within 1 % for x in -1..2, slightly too large beyond, where the value is small.
float transmitted(float x)
{
    x *= .25f;
    const float inverse = 1 + x * (1 + x * (.5f + x * .1667f)), squared = inverse * inverse;
    return 1 / (squared * squared);
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

void raise(Tissue& tissue, float mm)
{
    constexpr float dermis_mm = 1.5f, fat_mm = 6; // about the thickness of the layers, for small heights
    tissue.height_mm += mm;
    tissue.layer -= mm / (tissue.layer > 2 ? fat_mm : dermis_mm);
}

Vec3f mix(const Vec3f& a, const Vec3f& b, float t)
{
    return a + (b - a) * t;
}

Vec3f through(const Vec3f& base, const Vec3f& blood, float amount)
{
    return {base[0] * transmitted(amount * blood[0]), base[1] * transmitted(amount * blood[1]),
            base[2] * transmitted(amount * blood[2])};
}

float scrape_angle(std::uint32_t seed)
{
    return float(2 * CV_PI) * hash01(seed, 1, 2);
}

TissuePainter::TissuePainter(const WoundKind& kind, const SyntheticWound& wound, const Noise& noise)
    : kind_(kind), wound_(wound), noise_(noise)
{
    for (int channel = 0; channel < 3; ++channel)
        skin_[channel] = base::srgb_to_linear(float(wound.skin[channel]) / 255);
    for (int channel = 0; channel < int(turns_.size()); ++channel)
        turns_[channel] = {std::cos(2.4f * float(channel)),
                           std::sin(2.4f * float(channel))}; // the golden angle, radians
    const float angle = -scrape_angle(wound.seed);           // turned() turns the outline by the angle
    scrape_direction_ = {std::cos(angle), std::sin(angle)};
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
                 .35f * base::smoothstep(.2f, 2.f, inside_mm); // blood gathers in the depth
    return slow;
}

void TissuePainter::set_shares(const std::vector<SlowFields>& bed)
{
    std::vector<float> fibrin_values, clot_values;
    for (const SlowFields& slow : bed) {
        fibrin_values.push_back(slow[Fibrin]);
        clot_values.push_back(slow[Clot]);
    }
    fibrin_threshold_ = upper_quantile(std::move(fibrin_values), kind_.fibrin);
    clot_threshold_ = upper_quantile(std::move(clot_values), kind_.clot);
}

Tissue TissuePainter::at(const Place& place) const
{
    if (place.inside_mm > 0)
        return kind_.bed(*this, place);
    Tissue tissue = skin(place);
    if (place.inside_mm > -reach_mm) {
        inflame(tissue, place);
        if (kind_.beside != nullptr)
            kind_.beside(*this, tissue, place);
        smear_blood(tissue, place);
    }
    return tissue;
}

float TissuePainter::streaks(const Place& place) const
{
    const Point2f p = place.p + .35f * Point2f(place.slow[BendX], place.slow[BendY]);
    const Point2f q{p.dot(scrape_direction_), p.x * scrape_direction_.y - p.y * scrape_direction_.x};
    return .55f * noise_.at({q.x * .05f + 5, q.y * .55f}) + .55f * noise_.at({q.x * .11f + 5, q.y * 1.5f}) +
           .4f * noise_.at({q.x * .3f + 9, q.y * 3.4f});
}

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
    const float width = std::max(1.9f * (1 + 1.1f * spread), .8f);
    const float near = std::exp(-std::pow(out / width, 1.25f));
    const float far =
        std::exp(-out / 5.5f) * std::max(1 + 1.3f * spread, .2f) * (1 - base::smoothstep(7, reach_mm, out));
    const float tight = (out - .45f - .3f * mottle) / .5f; // near 0, swelling squeezes the blood out
    const float blanched = 1 - .5f * std::exp(-tight * tight) * std::clamp(.8f + 1.5f * spread, 0.f, 1.f);
    const float amount = kind_.inflamed * (near * std::max(.62f + .45f * mottle, .1f) * blanched +
                                           .14f * far * std::max(1 + .8f * mottle, 0.f));
    const float bruised = near * base::smoothstep(.0f, .5f, place.slow[Bruise]);
    tissue.reflectance = through(tissue.reflectance, mix(oxygenated, deoxygenated, .8f * bruised), amount);
    const float swelling = (out - 1.3f) / 1.5f;
    tissue.layer -= kind_.swollen_mm / 1.5f * (1 + .8f * spread) * std::exp(-swelling * swelling) *
                    base::smoothstep(0, 1.5f, out);
    tissue.wetness = .25f * near;
}

/// Films of blood that ran or were wiped, and spatter.
void TissuePainter::smear_blood(Tissue& tissue, const Place& place) const
{
    const Point2f p = place.p;
    if (kind_.smeared <= 0)
        return;
    const float out = -place.inside_mm;
    const float wipe = place.slow[Wiped] + .35f * place.slow[FilmPatches] - .04f * out;
    if (wipe > .05f) {
        const float film = base::smoothstep(.05f, .5f, wipe) *
                           std::max(.5f + 1.2f * noise(p, .9f, 32, 3), 0.f) *
                           (1 - base::smoothstep(4, 9, out));
        tissue.reflectance =
            through(tissue.reflectance, mix(oxygenated, dried, .3f), .9f * kind_.smeared * film);
    }
    const float splashed = .6f * place.slow[FilmPatches] - .035f * out;
    if (splashed < -.1f)
        return; // the noise below cannot reach the threshold
    const float speck = base::smoothstep(.54f, .66f, noise(p, .8f, 33, 3) + splashed);
    tissue.reflectance = mix(tissue.reflectance, Vec3f(.15f, .026f, .017f), .75f * kind_.smeared * speck);
    raise(tissue, .12f * kind_.smeared * speck);
}

/// Lobules of fat, about 1 mm, yellow and glossy, with blood in the clefts between them.
Tissue TissuePainter::fat_lobules(const Place& place) const
{
    const Point2f p = place.p + .9f * Point2f(place.slow[BendX], place.slow[BendY]) +
                      .22f * Point2f(noise(place.p, 1.1f, 47, 2), noise(place.p, 1.1f, 48, 2));
    const Cell coarse = cell_at(seed() + 3, p * .9f), fine = cell_at(seed() + 4, p * 2.1f);
    const float cleft =
        base::smoothstep(-.2f, .7f, coarse.second - coarse.nearest + .14f * noise(p, 1.3f, 46, 2));
    const float dome = cleft * (1 - .55f * coarse.nearest * coarse.nearest) +
                       .35f * base::smoothstep(0, .4f, fine.second - fine.nearest);
    const float film = noise(p, .6f, 45, 4), own = fraction(coarse.id * 2654435761u);
    Tissue tissue;
    const Vec3f yellow = mix(Vec3f(.82f, .60f, .30f), Vec3f(.78f, .52f, .22f), own);
    const float blood =
        std::max(.32f + 1.2f * film + .6f * (1 - cleft) + .7f * std::max(place.slow[Supply], 0.f), .1f);
    tissue.reflectance = through(yellow, oxygenated, blood) * (.86f + .12f * std::min(dome, 1.1f));
    tissue.layer = 2.1f; // for raise(); cut() sets it
    tissue.height_mm = .16f * (dome - .7f);
    tissue.wetness = .9f;
    return tissue;
}

Tissue TissuePainter::cut(const Place& place, float floor, float wall_mm, float fat) const
{
    const float rough = noise(place.p, 1.1f, 54, 4), fine = noise(place.p, 2.6f, 41, 3);
    const float wall = base::smoothstep(-.15f, std::max(wall_mm, .4f), place.inside_mm + .25f * rough);
    const float layer = floor * wall;
    Tissue red;
    const float deep = std::clamp(layer - 1, 0.f, 1.f);
    const float blood =
        std::max(1.1f + 2.f * deep + .8f * place.slow[Supply] + .6f * rough + .3f * fine, .3f);
    red.reflectance =
        through(pale_dermis, mix(oxygenated, deoxygenated, .15f * deep), blood) * (.93f + .1f * rough);
    red.height_mm = .12f * rough;
    red.wetness = .8f * base::smoothstep(.9f, 1.5f, layer);
    const float lobes = place.slow[Knobby] + .6f * place.slow[Floor] + .25f * rough;
    const float open = base::smoothstep(1.7f, 2.02f, layer + .05f * rough) *
                       base::smoothstep(-.2f, .25f, lobes + 1.2f * (std::clamp(fat, 0.f, 1.f) - .5f));
    const Tissue lobules = fat_lobules(place);
    Tissue tissue = red;
    tissue.reflectance = mix(red.reflectance, lobules.reflectance, open);
    tissue.wetness = std::lerp(red.wetness, lobules.wetness, open);
    tissue.height_mm = 0;
    tissue.layer = layer;
    raise(tissue, std::lerp(red.height_mm, lobules.height_mm, open) * wall);
    return tissue;
}

Tissue TissuePainter::granulation(const Place& place) const
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

    raise(tissue, .3f * (bump - .5f));
    tissue.wetness = .9f * base::smoothstep(.2f, .8f, place.inside_mm);
    return tissue;
}

void TissuePainter::lay_fibrin(Tissue& tissue, const Place& place) const
{
    const float over = place.slow[Fibrin] - fibrin_threshold_;
    if (over < -.45f)
        return;
    const Point2f p = place.p;
    const float bump = std::clamp(.5f + tissue.height_mm / .3f, 0.f, 1.f);
    const float mottle = noise(p, .75f, 64, 3), curl = noise(p, .3f, 63, 2);
    const float lines =
        1 - std::abs(noise_.at({.13f * p.x + .34f * p.y + .5f * curl, .24f * p.y - .10f * p.x + 40}));
    const float strand = base::smoothstep(.91f, .99f, lines) * base::smoothstep(-.40f, -.05f, over) *
                         std::clamp(.5f + 1.5f * mottle, 0.f, 1.f);
    const float sheet = base::smoothstep(-.3f, .4f, over + .35f * (.55f - bump) + .22f * mottle);
    const float thickness = std::clamp(.30f + 1.1f * over + .9f * mottle, 0.f, 1.f);
    const Vec3f colour =
        mix(Vec3f(.40f, .20f, .075f), Vec3f(.56f, .38f, .19f), thickness) * (1 + .10f * noise(p, 1.8f, 66));
    const float cover = std::max(sheet * (.36f + .44f * thickness), .5f * strand);
    tissue.reflectance = mix(tissue.reflectance, colour, cover);
    raise(tissue, cover * (.18f - .20f * bump + .12f * thickness));
}

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
        mix(Vec3f(.125f, .016f, .012f), Vec3f(.052f, .011f, .009f), thickness) * (1 + .45f * lumps);
    const float crack = base::smoothstep(.94f, .99f, 1 - std::abs(noise(p, .4f, 75, 2))) *
                        base::smoothstep(.1f, .4f, thickness);
    tissue.reflectance = mix(tissue.reflectance, colour, .92f * body * (1 - .6f * crack));
    raise(tissue, body * (.3f * thickness + .25f * lumps - .2f * crack));
    tissue.wetness = std::lerp(tissue.wetness, .8f, body);
}

} // namespace wound
