// Measurements of the reflectance models, for the tables of docs/optics.md.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/color.hpp"
#include "wound/optics/reflectance.hpp"
#include "wound/reflectance_table.hpp"

namespace base {
class Progress;
}

namespace lab {

struct TableOptions
{
    std::string tissue = "light"; // a preset that heals, or a tissue file
    optics::ReflectanceModel model = optics::ReflectanceModel::AddingDoubling;
    std::uint32_t size = wound::lut_size; // texels over depth, and over days
    double last_day = 60;
    std::filesystem::path out = "out/bake";
    optics::ReflectanceOptions reflectance_options{.angles = 4, .photons = 200'000};
};

/// Result of one model on one stack.
struct Measured
{
    optics::ReflectanceModel model;
    base::Color color;
    double rms_error = 0, delta_e = 0; // against Monte Carlo
    double seconds = 0;                // per channel
};
struct MeasuredStack
{
    std::string name;
    std::vector<Measured> models;
};
std::vector<MeasuredStack> measure_models(const optics::ReflectanceOptions& options,
                                          base::Progress& progress);
/// Interpolation error of each preset's table for each size (texels per side); for the options' tissue also
/// the total error against Monte Carlo.
nlohmann::ordered_json measure_table_sizes(const TableOptions& options, std::span<const std::uint32_t> sizes,
                                           base::Progress& progress);
/// Total error of the table of `options` against Monte Carlo.
nlohmann::ordered_json measure_table_against_walk(const TableOptions& options);
/// Writes the table "model | R G B | rms error | dE2000 | cost" as text to `out`, as compare.json and as a
/// chart, compare.png.
void compare(const TableOptions& options, std::ostream& out);

/// Fits the calibrated model's coefficients to the photon walk on 48 skin-like stacks. Writes its rms error
/// on these and on 48 others, with those of the built-in coefficients and of the two-stream model, to `out`
/// and calibration.json.
nlohmann::ordered_json calibrate(const TableOptions& options, std::ostream& out);

/// Compares Monte Carlo and adding-doubling with published values, and with each other on twelve random
/// stacks. Writes a table; returns false when a value is out of tolerance.
bool check_reflectance(const optics::ReflectanceOptions& options, std::ostream& out);

} // namespace lab
