// Which tissue and which reflectance model: what a user may name, for the commands and for scenes alike.
#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "wound/reflectance.hpp"
#include "wound/skin_presets.hpp"

namespace app {

/// A preset that heals, or a tissue file; InputError that lists the presets when it is neither, and for a
/// file in which no wound can be: its channels must be one, three or a spectrum, and every layer that has
/// others under it at most 100 mm thick.
wound::HealingTissue healing_tissue_or_file(const std::string& name);

/// Any preset, or any tissue file.
wound::SkinLayers tissue_or_file(const std::string& name);

/// `--model`, with all names and the default that `rung` has.
void add_model_option(CLI::App& command, wound::Rung& rung);

/// What to tell of Rung::Published on tissue with layers too thick for it; nothing when there is none.
std::optional<std::string> domain_note(const wound::SkinLayers& tissue);
wound::SkinLayers layers_of(const wound::HealingTissue& tissue); // without an injury

} // namespace app
