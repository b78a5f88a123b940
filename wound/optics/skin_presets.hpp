// Skin described by its chromophores, and how a wound in it changes from day to day: clot, granulation, new
// epithelium, scar, bruise. docs/optics.md, section 6, names each number's source or says that it was chosen
// by eye.
#pragma once
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "base/color.hpp"
#include "wound/optics/chromophores.hpp"
#include "wound/optics/healing_tissue.hpp"

namespace optics {

inline constexpr double days_per_month = 30.44;

struct ChromophoreSkin
{
    Chromophores epidermis, dermis, subcutis;
    double epidermis_mm = 0.1, dermis_mm = 1.8, subcutis_mm = 5;
    SkinLayers layers() const;
};

enum class SkinTone
{
    Light,  // fitted to the cheek of Caucasians, Xiao et al. 2017
    Medium, // fitted to Indian skin (upper arm), Alaluf et al. 2002
    Dark,   // fitted to African skin (sun-exposed forearm), Alaluf et al. 2002
};
ChromophoreSkin skin(SkinTone tone);

/// Tissue given by a table of coefficients, or by its chromophores.
using HealingTissue = std::variant<SkinLayers, ChromophoreSkin>;

/// The open wound `day` days after the injury. For SkinLayers: the paper's restored_skin().
TissueDay open_bed(const HealingTissue& tissue, double day, double depth_scale);

/// The wound under new epithelium: the pink ring, and after `closure_day` the scar. SkinLayers with three
/// channels, taken as 610, 540 and 450 nm, or with a spectrum get the excess of blood of the light preset's
/// scar; other SkinLayers are restored unchanged.
TissueDay covered_bed(const HealingTissue& tissue, double day, double closure_day);

/// Haemorrhage under uninjured skin: blue-red, then yellow with bilirubin, gone after about three weeks.
SkinLayers bruise(const ChromophoreSkin& skin, double day);

/// Skin colour measured by a spectrophotometer, specular light excluded.
struct MeasuredSkin
{
    std::string_view preset; // the preset that was fitted to this measurement
    std::string_view site, source;
    base::Lab lab; // D65, 10 degrees
};
std::span<const MeasuredSkin> measured_skins();

/// "table1" (facial), "light", "medium", "dark".
std::vector<std::string_view> healing_tissue_names();
std::optional<HealingTissue> healing_tissue_named(std::string_view name);

/// healing_tissue_names() and, on light skin, "granulation", "new-epithelium", "scar" (1 month), "bruise-1",
/// "bruise-6", "bruise-12" (days).
std::vector<std::string_view> tissue_preset_names();
std::optional<SkinLayers> tissue_preset(std::string_view name);

} // namespace optics
