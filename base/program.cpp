#include "base/program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <fmt/format.h>

#include "base/interrupt.hpp"

namespace base {
namespace {

void print_error(const CLI::App& program, std::string message)
{
    std::ranges::replace(message, '\n', ' ');
    fmt::print(stderr, "{}: {}\n", program.get_name(), message);
}

} // namespace

int run_program(CLI::App& program, int argc, char** argv)
{
    // A missing command is reported below, so that a misspelt one is reported by its name here.
    program.require_subcommand(0, 1);
    program.set_version_flag("--version", program.get_name() + " " CICATRIX_VERSION, "Print the version");
    try {
        program.parse(argc, argv);
        if (program.get_subcommands().empty())
            throw CLI::RequiredError("A command");
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) // --help
            return program.exit(error);
        std::string command = program.get_name();
        for (const CLI::App* used : program.get_subcommands())
            command += ' ' + used->get_name();
        print_error(program, fmt::format("{}; see {} --help", error.what(), command));
        return 2;
    } catch (const Interrupted&) {
        print_error(program, "stopped");
        return 128 + SIGINT;
    } catch (const std::exception& error) {
        print_error(program, error.what());
        return 1;
    }
    return 0;
}

} // namespace base
