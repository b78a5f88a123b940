// `cicatrix capture`: pictures of a wound healing, day by day. stage/capture.hpp does the work.
#pragma once

namespace CLI {
class App;
}

namespace capture_command {

void add(CLI::App& program);

} // namespace capture_command
