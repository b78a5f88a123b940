// `cicatrix bake`: the reflectance table as files, the colour of a wound over the days as in the paper's
// Figure 6, and, with
// --compare, every rung of the ladder against the photon walk.
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "apps/tissue_choice.hpp"
#include "passes/reflectance_lut.hpp"
#include "wound/reflectance.hpp"
#include "wound/skin_presets.hpp"

namespace app {

class Progress;

struct BakeOptions
{
    std::string tissue = "light"; // a preset that heals, or a tissue file
    wound::Rung rung = wound::Rung::AddingDoubling;
    std::uint32_t width = passes::lut_size, height = passes::lut_size; // texels over depth and over days
    double last_day = 60;
    std::filesystem::path out = "out/bake";
    wound::RungOptions rung_options{.angles = 4, .photons = 200'000};
};

/// Writes the tables (EXR and a labelled picture) and the strip of colours over days; says what it wrote on
/// `out`, and on `notes` where the model does not hold. Numerical rungs keep their tables in cache_folder().
void bake(const BakeOptions& options, std::ostream& out, std::ostream& notes);

/// The table of any rung, from cache_folder() or baked and kept there, with progress on a terminal.
cv::Mat3f kept_table(const passes::LutRows& rows, std::uint32_t width, wound::Rung rung,
                     wound::RungOptions options);

/// cicatrix/ in XDG_CACHE_HOME, else in ~/.cache.
std::filesystem::path cache_folder();

/// The tissue of a part of the table (LUT_OPEN, LUT_COVERED) under the default healing curve.
wound::TissueDay tissue_on(const wound::HealingTissue& tissue, shared::uint part, double day);

/// One rung on one stack.
struct Measured
{
    wound::Rung rung;
    wound::Color color;
    double rms_error = 0, delta_e = 0; // against Monte Carlo
    double seconds = 0;                // per channel
};
struct MeasuredStack
{
    std::string name;
    std::vector<Measured> rungs;
};
std::vector<MeasuredStack> measure_ladder(const wound::RungOptions& options, Progress& progress);
/// Interpolation error of every preset's tables of so many texels a side; of the options' tissue also the
/// whole error against Monte Carlo, and that of the options' own table.
nlohmann::ordered_json measure_table_sizes(const BakeOptions& options, std::span<const std::uint32_t> sizes,
                                           Progress& progress);
nlohmann::ordered_json measure_table_against_walk(const BakeOptions& options);
/// The table "rung | R G B | rms error | dE2000 | cost" as text on `out`, as compare.json and as a plot,
/// compare.png.
void compare(const BakeOptions& options, std::ostream& out);

/// Fits the calibrated rung's coefficients to the photon walk on 48 stacks like skin and tells its rms error
/// on those and on 48 others, beside the built-in ones' and Eddington's; on `out` and as calibration.json.
nlohmann::ordered_json calibrate(const BakeOptions& options, std::ostream& out);

void add_bake_command(CLI::App& app);

} // namespace app
