// The reflectance of healing tissue as a table over injury depth and day: axes, rows, and the table computed
// on the CPU by any model, in double precision, and cached on disk. passes/reflectance_lut.hpp bakes the
// models that a shader implements.
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

/// Texels over depth, and over the days of each part: the smallest size with an interpolation error of at
/// most .002 for every skin preset (docs/optics.md, section 9).
constexpr std::uint32_t lut_size = 64;

/// Day of a row, 0 <= row < rows.
double lut_row_day(std::size_t row, std::size_t rows, double last_day);

/// The tissue of a healing wound on every row's day, as layers.
struct LutRows
{
    std::vector<optics::TissueDay> days; // `rows` days of the open bed, then as many of the covered bed
    shared::LutAxes axes;
};
LutRows lut_rows(const optics::HealingTissue& tissue, const Healing& healing, std::size_t rows,
                 double last_day);

/// The tissue of a part of the table (LUT_OPEN, LUT_COVERED) under the default healing curve.
optics::TissueDay tissue_on(const optics::HealingTissue& tissue, shared::uint part, double day);

/// The texels that reflectance_lut.comp would write. `rows`: LutRows::days. Uses all cores; the calling
/// thread passes the finished share of the table to options.progress.
cv::Mat3f bake_reflectance_table(std::span<const optics::TissueDay> rows, std::uint32_t width,
                                 optics::ReflectanceModel model,
                                 const optics::ReflectanceOptions& options = {});

/// The table from a file in `folder`, named by a hash of its inputs; baked and stored if the file is missing
/// or damaged. If `folder` cannot be written, the next run bakes the table again.
cv::Mat3f cached_reflectance_table(const std::filesystem::path& folder,
                                   std::span<const optics::TissueDay> rows, std::uint32_t width,
                                   optics::ReflectanceModel model,
                                   const optics::ReflectanceOptions& options = {});

/// For pictures, of the models that no shader knows: an error below what shows, for seconds or minutes of
/// work.
inline const optics::ReflectanceOptions picture_table_options{.angles = 4, .photons = 2000}; // per wavelength

/// cached_reflectance_table() in base::cache_folder(), with progress on a terminal.
cv::Mat3f kept_table(const LutRows& rows, std::uint32_t width, optics::ReflectanceModel model,
                     optics::ReflectanceOptions options);

/// The table sampled bilinearly at lut_uv().
base::Color sample_table(const cv::Mat3f& table, const shared::LutAxes& axes, shared::uint part,
                         double injury_mm, double day);

} // namespace wound
