// Bakes the diffuse reflectance of healing tissue into a table over injury depth and day, which the forward
// pass samples through lut_uv (shaders/shared/reflectance_lut.h).
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "engine/graph.hpp"
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
};

/// Day of a row, for those who fill `rows`.
double lut_row_day(std::size_t row, std::size_t rows, double last_day);

/// The tissue of a healing wound on every row's day, for the open bed and for what new epithelium has
/// covered.
struct LutRows
{
    std::vector<wound::TissueDay> open, covered;
    shared::LutAxes axes;
};
LutRows lut_rows(const wound::HealingTissue& tissue, const wound::Healing& healing, std::size_t rows,
                 double last_day);

/// `rows`: the tissue on lut_row_day(0), (1), ..., with three channels and the same number of intact layers
/// each.
LutTissue lut_tissue(std::span<const wound::TissueDay> rows, double last_day);

struct ReflectanceLut
{
    engine::ImageId reflectance; // linear RGB, >= 0 and finite; u = injury depth, v = day
};

/// `rung`: one that the shader knows, up to Calibrated; others are computed on the CPU
/// (reflectance_table.hpp). Adds one compute pass `name`, which the graph skips while the tissue stands.
/// Width: texels over depth.
ReflectanceLut add_reflectance_lut(engine::Graph& graph, std::string_view name, const LutTissue& tissue,
                                   wound::Rung rung, std::uint32_t width = 32);

} // namespace passes
