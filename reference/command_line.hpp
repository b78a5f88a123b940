// Command-line options shared by the commands that trace pictures.
#pragma once
#include "reference/levels.hpp"

namespace CLI {
class App;
}

namespace reference {

/// --no-shadows, --no-ambient, --no-subsurface, --no-specular, --bounces, --anisotropy, --index.
void add_level_options(CLI::App& command, Levels& levels);

} // namespace reference
