// `cicatrix info`: the machine's Vulkan devices and what matters about them.
#pragma once

namespace CLI {
class App;
}

namespace info_command {

void add(CLI::App& program);

} // namespace info_command
