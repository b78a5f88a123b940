// `cicatrix figure`: Figures 1 to 9 of Choi & Chin 2014 and its frame rates, each drawn by one call, and a
// page that shows them all.
#pragma once

namespace CLI {
class App;
}

namespace figure_command {

void add(CLI::App& program);

} // namespace figure_command
