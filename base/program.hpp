// The common part of the programs' main() functions: commands, --version and error reporting.
#pragma once

namespace CLI {
class App;
}

namespace base {

/// Parses the command line and runs its command. Prints an error as one line on stderr. Returns 0 on success,
/// 1 for an error of the user's files or machine, 2 for a wrong command line, 130 for Ctrl-C.
int run_program(CLI::App& program, int argc, char** argv);

/// Milliseconds since this program started, the loading of its libraries included. The script `run` becomes
/// the program by exec and says in CICATRIX_STARTED (seconds since 1970) when; otherwise it is when the
/// kernel made the process, with a resolution of 10 ms.
double ms_since_start();

} // namespace base
