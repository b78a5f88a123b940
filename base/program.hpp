// The common part of the programs' main() functions: commands, --version and error reporting.
#pragma once

namespace CLI {
class App;
}

namespace base {

/// Parses the command line and runs its command. Prints an error as one line on stderr. Returns 0 on success,
/// 1 for an error of the user's files or machine, 2 for a wrong command line, 130 for Ctrl-C.
int run_program(CLI::App& program, int argc, char** argv);

} // namespace base
