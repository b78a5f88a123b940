// `cicatrix graph`: prints the schedule of a scene's frames, as text and in Graphviz format.
#pragma once

namespace CLI {
class App;
}

namespace graph_command {

void add(CLI::App& program);

} // namespace graph_command
