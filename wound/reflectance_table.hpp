// What healing tissue reflects, as a table over injury depth and day: its axes and rows, and the table itself
// computed on the CPU by any model, in double precision, and kept on disk. The models that a shader knows are
// baked by passes/reflectance_lut.hpp instead.
#pragma once
#include <filesystem>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "base/color.hpp"
#include "shaders/shared/reflectance_lut.h"
#include "wound/healing/healing.hpp"
#include "wound/optics/reflectance.hpp"
#include "wound/optics/skin_presets.hpp"

namespace wound {

/// Texels over depth, and of each part over the days: the smallest size that interpolates within .002 for
/// every skin preset (docs/optics.md, section 9).
constexpr std::uint32_t lut_size = 64;

/// Day of a row, for those who fill `rows`.
double lut_row_day(std::size_t row, std::size_t rows, double last_day);

/// The tissue of a healing wound on every row's day, as layers.
struct LutRows
{
    std::vector<optics::TissueDay> days; // `rows` of the open bed, then as many of what is covered
    shared::LutAxes axes;
};
LutRows lut_rows(const optics::HealingTissue& tissue, const Healing& healing, std::size_t rows,
                 double last_day);

/// The tissue of a part of the table (LUT_OPEN, LUT_COVERED) under the default healing curve.
optics::TissueDay tissue_on(const optics::HealingTissue& tissue, shared::uint part, double day);

/// The texels that reflectance_lut.comp would write. `rows` as for lut_tissue(); all cores work.
/// options.progress is told the finished share of the table, by the calling thread.
cv::Mat3f bake_reflectance_table(std::span<const optics::TissueDay> rows, std::uint32_t width,
                                 optics::ReflectanceModel model,
                                 const optics::ReflectanceOptions& options = {});

/// The same from `folder`, where it is kept under a name made from all it depends on; baked and stored when
/// it is not there or not whole. A folder that cannot be written costs the next run its time, nothing else.
cv::Mat3f cached_reflectance_table(const std::filesystem::path& folder,
                                   std::span<const optics::TissueDay> rows, std::uint32_t width,
                                   optics::ReflectanceModel model,
                                   const optics::ReflectanceOptions& options = {});

/// The table of any model, kept in base::cache_folder(), with progress on a terminal.
cv::Mat3f kept_table(const LutRows& rows, std::uint32_t width, optics::ReflectanceModel model,
                     optics::ReflectanceOptions options);

/// What bilinear sampling through lut_uv() returns.
base::Color sample_table(const cv::Mat3f& table, const shared::LutAxes& axes, shared::uint part,
                         double injury_mm, double day);

} // namespace wound
