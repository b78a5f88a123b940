// `cicatrix bake`: the reflectance table as files, and the colour of a wound over the days as in the paper's
// Figure 6.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>

#include "wound/optics/reflectance.hpp"
#include "wound/reflectance_table.hpp"

namespace CLI {
class App;
}

namespace bake_command {

struct BakeOptions
{
    std::string tissue = "light"; // a preset that heals, or a tissue file
    optics::ReflectanceModel model = optics::ReflectanceModel::AddingDoubling;
    std::uint32_t width = wound::lut_size, height = wound::lut_size; // texels over depth and over days
    double last_day = 60;
    std::filesystem::path out = "out/bake";
    optics::ReflectanceOptions reflectance_options{.angles = 4, .photons = 200'000};
};

/// Writes the tables (EXR and a labelled picture) and the strip of colours over days; says what it wrote on
/// `out`, and on `notes` where the model does not hold. Numerical levels keep their tables in cache_folder().
void bake(const BakeOptions& options, std::ostream& out, std::ostream& notes);

void add(CLI::App& app);

} // namespace bake_command
