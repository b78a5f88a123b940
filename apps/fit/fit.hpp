// `cicatrix fit AREAS.csv`: fits healing curves to a table of measured areas. Needs no Vulkan device.
#pragma once

namespace CLI {
class App;
}

namespace fit_command {

void add(CLI::App& program);

} // namespace fit_command
