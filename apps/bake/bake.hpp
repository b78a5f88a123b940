// `cicatrix bake`: writes the reflectance table and the colours of a wound by day (Figure 6 of the paper).
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
    std::string tissue = "light"; // a healing preset or a tissue file
    optics::ReflectanceModel model = optics::ReflectanceModel::AddingDoubling;
    std::uint32_t width = wound::lut_size, height = wound::lut_size; // texels over depth and over days
    double last_day = 60;
    std::filesystem::path out = "out/bake";
    optics::ReflectanceOptions reflectance_options{.angles = 4, .photons = 200'000};
};

/// Writes the tables (EXR and a labelled picture) and the strip of colours over the days. Prints the written
/// files to `out` and, if the tissue is outside the model's domain, a note to `notes`. Caches the tables in
/// base::cache_folder().
void bake(const BakeOptions& options, std::ostream& out, std::ostream& notes);

void add(CLI::App& app);

} // namespace bake_command
