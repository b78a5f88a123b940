#include "wound/optics/skin_presets.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace optics {

namespace {

constexpr double anisotropy = 0.8;
constexpr double epidermis_index = 1.45, dermis_index = 1.4, subcutis_index = 1.44, blood_index = 1.38;

Layer epidermis_layer(const Chromophores& content, double thickness_mm)
{
    return chromophore_layer("epidermis", content, anisotropy, epidermis_index, thickness_mm);
}

Layer dermis_layer(std::string name, const Chromophores& content, double thickness_mm)
{
    return chromophore_layer(std::move(name), content, anisotropy, dermis_index, thickness_mm);
}

// Loose, wet and full of capillaries: 5 to 15 % blood, and little collagen that scatters.
constexpr Chromophores granulation{.blood = .1,
                                   .oxygenation = .7,
                                   .water = .8,
                                   .baseline = .5,
                                   .scattering_500nm = 3,
                                   .scattering_power = 1.5};

// Fresh blood: loses its oxygen within hours and, as clot and crust, its thickness within days.
Layer blood_film(double day)
{
    const Chromophores blood{.blood = 1,
                             .oxygenation = .3 + .65 * std::exp(-day / .4),
                             .baseline = 0,
                             .scattering_500nm = 2,
                             .scattering_power = 1};
    return chromophore_layer("blood", blood, .98, blood_index, .06 * std::exp(-day / 2.5));
}

double months_since_closure(double day, double closure_day)
{
    return std::max(0.0, day - closure_day) / days_per_month;
}

// 0..1. Epithelium starts thin and pale and matures with one turnover of the epidermis, about 28 days. Until
// closure it grows evenly, so its mean age is half the time since the injury; then it ages with time.
double epithelium_maturity(double day, double closure_day)
{
    return 1 - std::exp(-(day - std::min(day, closure_day) / 2) / 28);
}
// Relative to healthy epidermis.
double epithelium_thickness(double day, double closure_day)
{
    return .35 + .65 * epithelium_maturity(day, closure_day);
}

Layer new_epithelium(const ChromophoreSkin& skin, double day, double closure_day)
{
    const double months = months_since_closure(day, closure_day);
    const double darkening = .35 * std::exp(-.235 * months) *
                             (1 - std::exp(-2 * months)); // measured: +24 % at 1, +15 % at 3 months
    // Pigment per area is complete at closure, whatever the thickness; the measured excess applies after
    // that.
    const double pigment = .3 + .7 * std::min(1., std::max(day, 0.) / closure_day);
    const double thickness = epithelium_thickness(day, closure_day);
    Chromophores content = skin.epidermis;
    content.melanosomes *= pigment * (1 + darkening) / thickness;
    return epidermis_layer(content, skin.epidermis_mm * thickness);
}

// Blood fraction. Before closure the ring is granulation tissue that loses its vessels; afterwards the scar's
// excess over the adjacent skin fades. Redness and pigment of the scar: Danielsen et al. 2013.
double scar_blood(double skin_blood, double day, double closure_day)
{
    const double redness = 2.055 / (1 + months_since_closure(day, closure_day) / 2.37);
    const double scar = std::min(granulation.blood, skin_blood * (1 + redness));
    return std::lerp(granulation.blood, scar, std::min(day / closure_day, 1.0));
}

// Collagen of new tissue lies in dense parallel bundles, which scatter more than the dermis. Its many vessels
// carry little-used blood. Our choice, so that a scar is red rather than brown in its first months and ends
// as light as the skin (docs/optics.md, section 6).
Layer scar_tissue(const ChromophoreSkin& skin, double day, double closure_day)
{
    Chromophores content = skin.dermis;
    content.blood = scar_blood(skin.dermis.blood, day, closure_day);
    content.oxygenation = std::lerp(.97, skin.dermis.oxygenation, skin.dermis.blood / content.blood);
    content.scattering_500nm *= 1.3;
    return dermis_layer("scar", content, 0);
}

} // namespace

SkinLayers ChromophoreSkin::layers() const
{
    return {.layers = {epidermis_layer(epidermis, epidermis_mm), dermis_layer("dermis", dermis, dermis_mm),
                       chromophore_layer("subcutis", subcutis, anisotropy, subcutis_index, subcutis_mm)},
            .n_above = 1,
            .n_below = subcutis_index};
}

ChromophoreSkin skin(SkinTone tone)
{
    // Fitted values; `scattering` is relative to excised skin (Salomatina et al. 2006).
    struct Fit
    {
        double melanosomes, blood, oxygenation, baseline, scattering;
    };
    constexpr std::array<Fit, 3> fits{
        {{.0083, .0173, .85, .50, .75}, {.0233, .0136, .84, .52, .82}, {.0696, .03, .85, .52, 1.04}}};
    const Fit& fit = fits[static_cast<std::size_t>(tone)];
    ChromophoreSkin result;
    result.epidermis = {.melanosomes = fit.melanosomes,
                        .baseline = fit.baseline,
                        .scattering_500nm = 7.1 * fit.scattering,
                        .scattering_power = 1.7};
    result.dermis = {.blood = fit.blood,
                     .oxygenation = fit.oxygenation,
                     .baseline = fit.baseline,
                     .scattering_500nm = 4.7 * fit.scattering,
                     .scattering_power = 1.9};
    result.subcutis = {.blood = .5 * fit.blood,
                       .oxygenation = fit.oxygenation,
                       .baseline = fit.baseline,
                       .scattering_500nm = 3.6 * fit.scattering,
                       .scattering_power = 1.4};
    return result;
}

TissueDay open_bed(const HealingTissue& tissue, double day, double depth_scale)
{
    if (const auto* table = std::get_if<SkinLayers>(&tissue))
        return restored_skin(*table, depth_scale);
    const auto& content = std::get<ChromophoreSkin>(tissue);
    return {.intact = content.layers(),
            .missing_ratio = depth_scale,
            .regrown_ratio = 1 - depth_scale,
            .regrown = dermis_layer("granulation", granulation, 0),
            .cover = blood_film(day)};
}

namespace {

// The regrown tissue is the second layer with a scar's excess of blood. The first layer covers it at full
// thickness, because in a table it holds most of the skin's colour.
TissueDay covered_table(const SkinLayers& table, double day, double closure_day)
{
    TissueDay result = restored_skin(table, 0);
    result.regrown_ratio = 1;
    result.regrown = table.layers[table.layers.size() > 1 ? 1 : 0];
    if (table.layers.size() > 1)
        result.cover = table.layers[0];
    const ChromophoreSkin light = skin(SkinTone::Light);
    const Layer blood = chromophore_layer(
        "blood", {.blood = 1, .oxygenation = light.dermis.oxygenation, .baseline = 0}, 0, blood_index, 0);
    const double excess = scar_blood(light.dermis.blood, day, closure_day) - light.dermis.blood;
    constexpr std::array<std::size_t, 3> rgb{21, 14, 5}; // 610, 540, 450 nm
    for (std::size_t i = 0; i < table.channels(); ++i)
        if (table.channels() == rgb.size() || table.channels() == wavelength_count)
            result.regrown.sigma_a[i] += excess * blood.sigma_a[table.channels() == rgb.size() ? rgb[i] : i];
    return result;
}

} // namespace

TissueDay covered_bed(const HealingTissue& tissue, double day, double closure_day)
{
    if (const auto* table = std::get_if<SkinLayers>(&tissue))
        return covered_table(*table, day, closure_day);
    const auto& content = std::get<ChromophoreSkin>(tissue);
    return {.intact = content.layers(),
            .missing_ratio = 0,
            .regrown_ratio = 1,
            .regrown = scar_tissue(content, day, closure_day),
            .cover = new_epithelium(content, day, closure_day)};
}

SkinLayers bruise(const ChromophoreSkin& skin, double day)
{
    // Extravasated blood loses its oxygen in a day and breaks down with a time constant of 5 days; its
    // bilirubin peaks about day 6 and is cleared (colours by day: Langlois & Gresham 1991).
    const double left = std::exp(-day / 5), freed = day / 6 * std::exp(1 - day / 6);
    Chromophores content = skin.dermis;
    const double spilt = .06 * left;
    content.oxygenation =
        (content.blood * content.oxygenation + spilt * (.2 + .5 * std::exp(-day))) / (content.blood + spilt);
    content.blood += spilt;
    content.bilirubin_mmol_l = .15 * freed;
    SkinLayers result = skin.layers();
    constexpr double depth_mm = .3; // thickness of the blood pool under the epidermis
    result.layers[1].thickness_mm = depth_mm;
    result.layers.insert(result.layers.begin() + 2,
                         dermis_layer("bruise", content, skin.dermis_mm - depth_mm));
    return result;
}

std::span<const MeasuredSkin> measured_skins()
{
    static constexpr std::array<MeasuredSkin, 3> skins{
        {{"light", "cheek, Caucasians", "Xiao et al. 2017", {59.6, 11.8, 14.6}},
         {"medium", "upper arm, Indian", "Alaluf et al. 2002", {53.7, 10.3, 17.9}},
         {"dark", "forearm, African", "Alaluf et al. 2002", {38.14, 12.66, 15.04}}}};
    return skins;
}

namespace {

struct HealingPreset
{
    std::string_view name;
    HealingTissue (*tissue)();
};
constexpr std::array<HealingPreset, 4> healing_presets{{
    {"table1",
     [] {
         SkinLayers tissue = table1();
         tissue.facial = true;
         return HealingTissue(tissue);
     }},
    {"light", [] { return HealingTissue(skin(SkinTone::Light)); }},
    {"medium", [] { return HealingTissue(skin(SkinTone::Medium)); }},
    {"dark", [] { return HealingTissue(skin(SkinTone::Dark)); }},
}};

// Injured light skin on one day.
struct InjuredPreset
{
    std::string_view name;
    SkinLayers (*tissue)(const ChromophoreSkin& light);
};
constexpr double wound_depth_mm = 1, wound_closure_day = 21;
constexpr std::array<InjuredPreset, 6> injured_presets{{
    {"granulation", [](const ChromophoreSkin& s) { return layers_at(open_bed(s, 14, .5), wound_depth_mm); }},
    {"new-epithelium",
     [](const ChromophoreSkin& s) {
         return layers_at(covered_bed(s, 10, wound_closure_day), wound_depth_mm);
     }},
    {"scar",
     [](const ChromophoreSkin& s) {
         return layers_at(covered_bed(s, wound_closure_day + days_per_month, wound_closure_day),
                          wound_depth_mm);
     }},
    {"bruise-1", [](const ChromophoreSkin& s) { return bruise(s, 1); }},
    {"bruise-6", [](const ChromophoreSkin& s) { return bruise(s, 6); }},
    {"bruise-12", [](const ChromophoreSkin& s) { return bruise(s, 12); }},
}};

} // namespace

std::vector<std::string_view> healing_tissue_names()
{
    std::vector<std::string_view> names;
    for (const HealingPreset& preset : healing_presets)
        names.push_back(preset.name);
    return names;
}

std::vector<std::string_view> tissue_preset_names()
{
    std::vector<std::string_view> names = healing_tissue_names();
    for (const InjuredPreset& preset : injured_presets)
        names.push_back(preset.name);
    return names;
}

std::optional<HealingTissue> healing_tissue_named(std::string_view name)
{
    for (const HealingPreset& preset : healing_presets)
        if (preset.name == name)
            return preset.tissue();
    return {};
}

std::optional<SkinLayers> tissue_preset(std::string_view name)
{
    if (const auto tissue = healing_tissue_named(name)) {
        const auto* table = std::get_if<SkinLayers>(&*tissue);
        return table ? *table : std::get<ChromophoreSkin>(*tissue).layers();
    }
    for (const InjuredPreset& preset : injured_presets)
        if (preset.name == name)
            return preset.tissue(skin(SkinTone::Light));
    return {};
}

} // namespace optics
