#include "wound/skin_blend.hpp"

#include <algorithm>
#include <cmath>

#include "wound/reflectance_table.hpp"

namespace wound {

namespace {

constexpr double inflamed_mm = .25; // the inflamed rim is as red as a covered injury of this depth

base::Color reflectance(const WoundLook& wound, shared::uint part, double injury_mm)
{
    return sample_table(wound.reflectance, wound.axes, part, injury_mm, wound.today.day);
}

/// The face's own skin over a covered injury: multiplied by the ratio of the table's colours with and without
/// the injury.
base::Color covered_skin(const WoundLook& wound, double injury_mm, const base::Color& skin)
{
    const base::Color unhurt = reflectance(wound, shared::LUT_COVERED, 0),
                      covered = reflectance(wound, shared::LUT_COVERED, injury_mm);
    base::Color result;
    for (int c = 0; c < 3; ++c)
        result[c] = std::min(skin[c] * covered[c] / std::max(unhurt[c], 1e-3), 1.);
    return result;
}

template <class Vector>
Vector mix(const Vector& a, const Vector& b, double t)
{
    return (1 - t) * a + t * b;
}

/// C of eq. (4) where the wound is opaque. The photograph does not show the new epithelium between bed and
/// border, so its W is R, and r is 0 because R itself recovers from day to day. The rim is not injured but
/// inflamed; R gradually replaces its colour in the photograph.
base::Color wound_color(const WoundLook& wound, const MapSample& here, const base::Color& skin,
                        optics::BlendModel model)
{
    const double bed = here.state[2], inside = here.state[3], epithelium = wound.today.border_softness;
    const double renewed = epithelium * (1 - bed);
    const double recovery =
        std::lerp(wound.today.border_recovery * (1 - epithelium * inside), wound.today.bed_recovery, bed);
    base::Color texture(here.color[0], here.color[1], here.color[2]);
    base::Color tissue = reflectance(wound, shared::LUT_OPEN, here.state[0]);
    if (renewed > 0) {
        const base::Color new_skin =
            covered_skin(wound, std::max(here.state[1], inflamed_mm * (1 - inside)), skin);
        texture = mix(texture, new_skin, renewed);
        tissue = mix(tissue, new_skin, renewed);
    }
    return optics::blend(model, texture, tissue, skin, recovery);
}

} // namespace

SkinPoint with_wound(SkinPoint skin, const WoundLook& wound, const PatchPlace& place,
                     optics::BlendModel model)
{
    const MapSample here = sample(wound.maps, place.at, place.footprint);
    const double opacity = here.color[3] * place.facing;
    if (opacity <= 0)
        return skin;
    skin.albedo = mix(skin.albedo, wound_color(wound, here, skin.albedo, model), opacity);

    const ScarState& scar = wound.today.scar;
    const double fresh =
        1 - std::clamp(wound.today.bed_recovery, 0., 1.); // share of the bed that is still visible
    const double bed = here.state[2] * opacity,
                 ring = wound.today.border_softness * std::clamp(here.state[3] - here.state[2], 0., 1.),
                 taut = ring * opacity;
    // The bed reduces the face's pores partly: the rest serves as its own unevenness. Height is -depth, so
    // the relief's slope is added to the normal.
    const cv::Vec3d smoothed =
        mix(skin.normal, place.geometric, std::clamp(.4 * bed * fresh + scar.pore_loss * taut, 0., 1.));
    skin.normal =
        cv::normalize(smoothed + place.facing * (here.relief[0] * place.right + here.relief[1] * place.down));
    skin.occlusion *= std::lerp(1., here.relief[2], place.facing);
    skin.wetness = std::max(skin.wetness, bed * std::sqrt(fresh));
    skin.tautness = std::max(skin.tautness, scar.sheen * taut);
    skin.slope_variance += place.facing * place.facing * here.slope_variance;
    return skin;
}

optics::Shading with_gloss(optics::Shading shading, const SkinPoint& skin)
{
    if (optics::only_ward(shading))
        return shading;
    const double wet = shading.specular_model == optics::SpecularModel::Ward ? .4 * skin.wetness : 0;
    const double narrower = (1 - wet) * (1 - .25 * skin.tautness);
    shading.alpha_x *= narrower;
    shading.alpha_y *= narrower;
    shading.rho_s *= 1 - wet + .15 * skin.tautness;
    return shading;
}

optics::Finish finish_of(const SkinPoint& skin)
{
    return {skin.wetness, skin.slope_variance};
}

} // namespace wound
