// `cicatrix wound PHOTO`: shows how a photograph is processed. Needs no Vulkan device.
#pragma once

namespace CLI {
class App;
}

namespace wound_command {

void add(CLI::App& program);

} // namespace wound_command
