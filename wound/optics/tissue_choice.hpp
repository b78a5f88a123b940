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

/// A note for the user that names the layers and channels that are too thick for eqs. (2) and (3):
/// ReflectanceModel::Published limits them, Printed does not. nullopt for other models, or if there are none.
std::optional<std::string> domain_note(const SkinLayers& tissue, ReflectanceModel model);
SkinLayers layers_of(const HealingTissue& tissue); // without an injury

} // namespace optics
