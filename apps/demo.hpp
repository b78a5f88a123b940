// `cicatrix demo [SCENE]`: the window.
#pragma once
#include <CLI/CLI.hpp>

namespace app {

void add_demo_command(CLI::App& program);

} // namespace app
