// `cicatrix graph`: the schedule of a scene's frames, as text and as Graphviz.
#pragma once
#include <CLI/CLI.hpp>

namespace app {

void add_graph_command(CLI::App& program);

} // namespace app
