// `cicatrix info`: lists the machine's Vulkan devices and the features that Cicatrix uses.
#pragma once

namespace CLI {
class App;
}

namespace info_command {

void add(CLI::App& program);

} // namespace info_command
