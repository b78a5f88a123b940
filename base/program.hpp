// What our programs' main() functions share: commands, --version, and how an error ends.
#pragma once

namespace CLI {
class App;
}

namespace base {

/// Parses the command line and runs the command that it names. What a user's file or machine does wrong ends
/// as one line on stderr and exit code 1; a wrong command line as one line and 2; Ctrl-C as 130.
int run_program(CLI::App& program, int argc, char** argv);

} // namespace base
