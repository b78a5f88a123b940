// Finds a tissue by the name that a user gives on the command line or in a scene.
#pragma once
#include <optional>
#include <string>

#include "wound/optics/reflectance.hpp"
#include "wound/optics/skin_presets.hpp"

namespace optics {

/// A preset of healing_tissue_names(), or a tissue file with 1, 3 or wavelength_count channels whose layers,
/// except the last, are at most 100 mm thick. Throws base::InputError otherwise.
HealingTissue healing_tissue_or_file(const std::string& name);

/// Any preset, or any tissue file.
SkinLayers tissue_or_file(const std::string& name);

/// A note for the user when layers are too thick for ReflectanceModel::Published; nullopt when none is.
std::optional<std::string> domain_note(const SkinLayers& tissue);
SkinLayers layers_of(const HealingTissue& tissue); // without an injury

} // namespace optics
