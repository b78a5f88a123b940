// `cicatrix reference SCENE.json`: the scene path traced, on the CPU, as the truth that pictures are measured
// against.
#pragma once

namespace CLI {
class App;
}

namespace reference_command {

void add(CLI::App& app);

} // namespace reference_command
