// Measures of the reflectance models: what the tables of docs/optics.md say.
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
    std::uint32_t size = wound::lut_size; // texels over depth and over days
    double last_day = 60;
    std::filesystem::path out = "out/bake";
    optics::ReflectanceOptions reflectance_options{.angles = 4, .photons = 200'000};
};

/// One model on one stack.
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
/// Interpolation error of every preset's tables of so many texels a side; of the options' tissue also the
/// whole error against Monte Carlo, and that of the options' own table.
nlohmann::ordered_json measure_table_sizes(const TableOptions& options, std::span<const std::uint32_t> sizes,
                                           base::Progress& progress);
nlohmann::ordered_json measure_table_against_walk(const TableOptions& options);
/// The table "model | R G B | rms error | dE2000 | cost" as text on `out`, as compare.json and as a plot,
/// compare.png.
void compare(const TableOptions& options, std::ostream& out);

/// Fits the calibrated model's coefficients to the photon walk on 48 stacks like skin and tells its rms error
/// on those and on 48 others, beside the built-in ones' and Eddington's; on `out` and as calibration.json.
nlohmann::ordered_json calibrate(const TableOptions& options, std::ostream& out);

/// Compares Monte Carlo and adding-doubling with published values and with each other on twelve random
/// stacks. Writes a table; false when a value is out of its tolerance.
bool check_reflectance(const optics::ReflectanceOptions& options, std::ostream& out);

} // namespace lab
