// `cicatrix reflect TISSUE.json`: prints what layered tissue reflects, transmits and absorbs, by any model.
#pragma once
#include <iosfwd>
#include <string>

#include "wound/optics/reflectance.hpp"

namespace CLI {
class App;
}

namespace reflect_command {

struct ReflectOptions
{
    std::string tissue; // a preset's name or a file
    optics::ReflectanceModel model = optics::ReflectanceModel::TwoStream;
    optics::ReflectanceOptions reflectance_options;
};

/// Writes one JSON object to `out`, and a line to `notes` for each limit of the model that is exceeded.
void reflect(const ReflectOptions& options, std::ostream& out, std::ostream& notes);

void add(CLI::App& app);

} // namespace reflect_command
