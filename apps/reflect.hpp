// `cicatrix reflect TISSUE.json`: what layered tissue reflects, transmits and absorbs, by any rung of the
// ladder.
#pragma once
#include <CLI/CLI.hpp>
#include <iosfwd>
#include <string>

#include "wound/reflectance.hpp"

namespace app {

struct ReflectOptions
{
    std::string tissue; // a preset's name or a file
    wound::Rung rung = wound::Rung::TwoStream;
    wound::RungOptions rung_options;
};

/// Writes one JSON object to `out`; to `notes`, lines on where the model does not hold.
void reflect(const ReflectOptions& options, std::ostream& out, std::ostream& notes);

/// Compares Monte Carlo and adding-doubling with published values and with each other on twelve random
/// stacks. Writes a table; false when a value is out of its tolerance.
bool check_reflectance(const wound::RungOptions& options, std::ostream& out);

void add_reflect_command(CLI::App& app);

} // namespace app
