// The reflectance table computed on the CPU by any rung of the ladder, in double precision, and kept on disk:
// for rungs that a shader cannot evaluate, adding-doubling above all.
#pragma once
#include <filesystem>
#include <opencv2/core.hpp>

#include "engine/texture.hpp"
#include "passes/reflectance_lut.hpp"
#include "wound/color.hpp"

namespace passes {

/// The texels that reflectance_lut.comp would write. `rows` as for lut_tissue(); all cores work.
/// options.progress is told the finished share of the table, by the calling thread.
cv::Mat3f bake_reflectance_table(std::span<const wound::TissueDay> rows, std::uint32_t width,
                                 wound::Rung rung, const wound::RungOptions& options = {});

/// The same from `folder`, where it is kept under a name made from all it depends on; baked and stored when
/// it is not there or not whole. A folder that cannot be written costs the next run its time, nothing else.
cv::Mat3f cached_reflectance_table(const std::filesystem::path& folder,
                                   std::span<const wound::TissueDay> rows, std::uint32_t width,
                                   wound::Rung rung, const wound::RungOptions& options = {});

/// Half floats, as the shader stores them, for LutTissue::table.
engine::Texture upload_reflectance_table(const engine::Device& device, const cv::Mat3f& table,
                                         const std::string& name);

/// What bilinear sampling through lut_uv() returns.
wound::Color sample_table(const cv::Mat3f& table, const shared::LutAxes& axes, shared::uint part,
                          double injury_mm, double day);

} // namespace passes
