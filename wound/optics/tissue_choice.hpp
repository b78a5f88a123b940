// Which tissue and which reflectance model: what a user may name, for the commands and for scenes alike.
#pragma once
#include <optional>
#include <string>

#include "wound/optics/reflectance.hpp"
#include "wound/optics/skin_presets.hpp"

namespace optics {

/// A preset that heals, or a tissue file; InputError that lists the presets when it is neither, and for a
/// file in which no wound can be: its channels must be one, three or a spectrum, and every layer that has
/// others under it at most 100 mm thick.
HealingTissue healing_tissue_or_file(const std::string& name);

/// Any preset, or any tissue file.
SkinLayers tissue_or_file(const std::string& name);

/// What to tell of ReflectanceModel::Published on tissue with layers too thick for it; nothing when there is
/// none.
std::optional<std::string> domain_note(const SkinLayers& tissue);
SkinLayers layers_of(const HealingTissue& tissue); // without an injury

} // namespace optics
