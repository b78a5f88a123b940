// The commands of cicatrix-lab: what only makes the tables of docs/.
#pragma once

namespace CLI {
class App;
}

namespace lab {

/// Error, area, folds and cost of every warp: docs/warp.md.
void add_warps(CLI::App& program);
/// Every reflectance model against the photon walk, the table's size, the presets: docs/optics.md.
void add_compare_models(CLI::App& program);
/// Fits the model `calibrated` to the photon walk: docs/optics.md.
void add_calibrate(CLI::App& program);
/// Published values against ours: docs/optics.md, section 7.
void add_check_reflectance(CLI::App& program);
/// The share of light that each form of Ward's lobe returns: docs/shading.md.
void add_ward_albedo(CLI::App& program);
/// The tables of docs/scene.md, from the table of fields.
void add_scene_fields(CLI::App& program);

} // namespace lab
