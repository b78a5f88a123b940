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

/// The tissue of every row in the shader's format. Compute it once per tissue and healing curve, and reuse
/// it.
struct LutTissue
{
    graph::Bytes layers;  // shared::LutLayer, grouped by row
    graph::Bytes bands;   // shared::LutBand, grouped by layer
    graph::Bytes weights; // shared::mat3, per band: its channels -> linear RGB
    graph::Bytes days;    // shared::LutDay, one per row
    std::uint32_t rows = 0;
    shared::LutParameters parameters;
    /// The finished table, for a model that the shader does not implement (wound/reflectance_table.hpp).
    /// None: a compute pass bakes the table.
    std::shared_ptr<const gpu::Texture> table;
};

/// `rows`: LutRows::days, all with the same number of channels and of intact layers.
LutTissue lut_tissue(std::span<const optics::TissueDay> rows, double last_day);

struct ReflectanceLut
{
    graph::ImageId reflectance; // linear RGB, >= 0 and finite; u = injury depth, v = part and day
};

/// Adds one compute pass `name`, which the graph skips while the tissue is unchanged; adds none if the tissue
/// has a table. Without a table, the shader must implement `model` (up to Calibrated). `width`: number of
/// texels along depth.
ReflectanceLut add_reflectance_lut(graph::Graph& graph, std::string_view name, const LutTissue& tissue,
                                   optics::ReflectanceModel model, std::uint32_t width = wound::lut_size);

/// Uploads a table as half floats, the format of the baked one, for LutTissue::table.
gpu::Texture upload_reflectance_table(const gpu::Device& device, const cv::Mat3f& table,
                                      const std::string& name);

} // namespace passes
