// `cicatrix capture`: pictures of a wound healing, day by day, and what each cost.
#pragma once
#include <CLI/CLI.hpp>

namespace app {

void add_capture_command(CLI::App& program);

} // namespace app
