// Bakes the diffuse reflectance of healing tissue into a table over injury depth and day, which the forward
// pass samples through lut_uv (shaders/shared/reflectance_lut.h).
#pragma once
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "engine/graph.hpp"
#include "engine/texture.hpp"
#include "shaders/shared/reflectance_lut.h"
#include "wound/healing.hpp"
#include "wound/reflectance.hpp"
#include "wound/skin_presets.hpp"

namespace passes {

/// The tissue of every row as the shader reads it. Make it when the tissue or the healing curve changes and
/// keep it.
struct LutTissue
{
    std::vector<shared::LutLayer> layers; // of every row in turn
    std::vector<shared::LutBand> bands;   // of every layer in turn
    std::vector<shared::mat3> weights;    // of every band: its channels -> linear RGB
    std::vector<shared::LutDay> days;     // one per row
    shared::LutParameters parameters;
    /// The finished table, of a rung that the shader does not know (reflectance_table.hpp). None: it is baked
    /// by a compute pass.
    std::shared_ptr<const engine::Texture> table;
};

/// Texels over depth, and of each part over the days: the smallest size that interpolates within .002 for
/// every skin preset (docs/optics.md, section 9).
constexpr std::uint32_t lut_size = 64;

/// Day of a row, for those who fill `rows`.
double lut_row_day(std::size_t row, std::size_t rows, double last_day);

/// The tissue of a healing wound on every row's day, as layers.
struct LutRows
{
    std::vector<wound::TissueDay> days; // `rows` of the open bed, then as many of what is covered
    shared::LutAxes axes;
};
LutRows lut_rows(const wound::HealingTissue& tissue, const wound::Healing& healing, std::size_t rows,
                 double last_day);

/// `rows`: LutRows::days, all with the same number of channels and of intact layers.
LutTissue lut_tissue(std::span<const wound::TissueDay> rows, double last_day);

struct ReflectanceLut
{
    engine::ImageId reflectance; // linear RGB, >= 0 and finite; u = injury depth, v = part and day
};

/// `rung`: one that the shader knows, up to Calibrated, unless the tissue brings its table. Adds one compute
/// pass `name`, which the graph skips while the tissue stands; with a table none.
/// Width: texels over depth.
ReflectanceLut add_reflectance_lut(engine::Graph& graph, std::string_view name, const LutTissue& tissue,
                                   wound::Rung rung, std::uint32_t width = lut_size);

} // namespace passes
