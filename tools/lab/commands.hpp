// The commands of cicatrix-lab, which make the tables of docs/.
#pragma once

namespace CLI {
class App;
}

namespace lab {

/// Error, area, folds and cost of every warp: docs/warp.md.
void add_warps(CLI::App& program);
/// Errors of the reflectance models, table sizes and skin presets: docs/optics.md.
void add_compare_models(CLI::App& program);
/// Fits the model `calibrated` to the photon walk: docs/optics.md.
void add_calibrate(CLI::App& program);
/// Compares published values with ours: docs/optics.md, section 7.
void add_check_reflectance(CLI::App& program);
/// Albedo of each form of Ward's lobe: docs/shading.md.
void add_ward_albedo(CLI::App& program);
/// The tables of docs/scene.md, from scene/field_table.hpp.
void add_scene_fields(CLI::App& program);

/// What each term of the shading costs: docs/shading.md.
void add_terms(CLI::App& program);
/// Distance from the path-traced reference: docs/truth.md.
void add_truth(CLI::App& program);

} // namespace lab
