// `cicatrix wound PHOTO`: what is made of a photograph. Needs no Vulkan device.
#pragma once

namespace CLI {
class App;
}

namespace wound_command {

void add(CLI::App& program);

} // namespace wound_command
