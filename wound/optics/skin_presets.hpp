// Skin by its chromophores, and how a wound in it changes from day to day: clot, granulation, new epithelium,
// scar, bruise. Every number's source, and what was chosen by eye, is in docs/optics.md, section 6.
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

/// Tissue without and with chromophores: what an optical table says, or what the contents say.
using HealingTissue = std::variant<SkinLayers, ChromophoreSkin>;

/// The open wound `day` days after the injury. Table tissue: the paper's restored_skin().
TissueDay open_bed(const HealingTissue& tissue, double day, double depth_scale);

/// Where new epithelium has covered the wound: the pink ring, and after `closure_day` the scar. A table of
/// three channels, taken as 610, 540 and 450 nm, or a spectrum gets the excess of blood that
/// the light preset's scar has; of other tables nothing is known but that they are whole again.
TissueDay covered_bed(const HealingTissue& tissue, double day, double closure_day);

/// Haemorrhage under uninjured skin: blue-red, then yellow with bilirubin, gone after about three weeks.
SkinLayers bruise(const ChromophoreSkin& skin, double day);

/// Skin as a spectrophotometer saw it, specular light excluded.
struct MeasuredSkin
{
    std::string_view preset; // fitted to it
    std::string_view site, source;
    base::Lab lab; // D65, 10 degrees
};
std::span<const MeasuredSkin> measured_skins();

/// "table1", "light", "medium", "dark": skin that can heal.
std::vector<std::string_view> healing_tissue_names();
std::optional<HealingTissue> healing_tissue_named(std::string_view name);

/// Those and "granulation", "new-epithelium", "scar" (1 month), "bruise-1", "bruise-6", "bruise-12" (days),
/// on light skin.
std::vector<std::string_view> tissue_preset_names();
std::optional<SkinLayers> tissue_preset(std::string_view name);

} // namespace optics
