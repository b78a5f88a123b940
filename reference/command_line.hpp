// Command-line options shared by the commands that trace pictures.
#pragma once
#include "reference/truth.hpp"

namespace CLI {
class App;
}

namespace reference {

/// --no-shadows, --no-ambient, --no-subsurface, --no-specular, --bounces, --anisotropy, --index.
void add_level_options(CLI::App& command, Levels& levels);

/// --samples, --noise, --seconds.
void add_until_options(CLI::App& command, Until& until);

} // namespace reference
