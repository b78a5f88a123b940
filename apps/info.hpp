// `cicatrix info`: the machine's Vulkan devices and what matters about them.
#pragma once
#include <CLI/CLI.hpp>

namespace app {

void add_info_command(CLI::App& program);

} // namespace app
