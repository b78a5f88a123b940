// Bakes the diffuse reflectance of healing tissue into a table over injury depth and day, which the forward
// pass samples through lut_uv (shaders/shared/reflectance_lut.h).
#pragma once
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "engine/gpu/texture.hpp"
#include "engine/graph/graph.hpp"
#include "shaders/shared/reflectance_lut.h"
#include "wound/optics/reflectance.hpp"
#include "wound/reflectance_table.hpp"

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
    /// The finished table, of a model that the shader does not know (wound/reflectance_table.hpp). None: it
    /// is baked by a compute pass.
    std::shared_ptr<const gpu::Texture> table;
};

/// `rows`: LutRows::days, all with the same number of channels and of intact layers.
LutTissue lut_tissue(std::span<const optics::TissueDay> rows, double last_day);

struct ReflectanceLut
{
    graph::ImageId reflectance; // linear RGB, >= 0 and finite; u = injury depth, v = part and day
};

/// `model`: one that the shader knows, up to Calibrated, unless the tissue brings its table. Adds one compute
/// pass `name`, which the graph skips while the tissue stands; with a table none.
/// Width: texels over depth.
ReflectanceLut add_reflectance_lut(graph::Graph& graph, std::string_view name, const LutTissue& tissue,
                                   optics::ReflectanceModel model, std::uint32_t width = wound::lut_size);

/// Half floats, as the shader stores them, for LutTissue::table.
gpu::Texture upload_reflectance_table(const gpu::Device& device, const cv::Mat3f& table,
                                      const std::string& name);

} // namespace passes
