// Reads tissue from a JSON file: layers from the top down, each given by its coefficients or its
// chromophores. Units and ranges: docs/scene.md.
//
//   {"unit": "1/mm" or "1/cm", "n_above": 1, "n_below": 1, "layers": [{"name": "dermis", "n": 1.4, "g": 0,
//     "thickness_mm": 1.8 or "inf",
//     "sigma_a": 0.2 or [r, g, b], "sigma_s_reduced": ... or "sigma_s": ...}]}
//
// A coefficient is one number for all channels or one number per channel. A layer may have, instead of
// coefficients, "chromophores": {"melanosomes", "blood", "oxygenation", "bilirubin_mmol_l", "water",
// "baseline", "scattering_500nm_per_mm", "scattering_power"}; the tissue then has wavelength_count channels.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "wound/optics/tissue.hpp"

namespace optics {

/// Throw base::InputError naming the file (`file`) and the field.
SkinLayers parse_tissue(const nlohmann::json& json, std::string_view file);
SkinLayers read_tissue(const std::filesystem::path& path);

} // namespace optics
