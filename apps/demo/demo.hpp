// `cicatrix demo [SCENE]`: the interactive window.
#pragma once

namespace CLI {
class App;
}

namespace demo_command {

void add(CLI::App& program);

} // namespace demo_command
