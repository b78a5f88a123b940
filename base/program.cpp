#include "base/program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <sstream>
#include <time.h>
#include <unistd.h>

#include "base/interrupt.hpp"
#include "base/text.hpp"

namespace base {
namespace {

void print_error(const CLI::App& program, std::string_view message)
{
    fmt::print(stderr, "{}: {}\n", program.get_name(), printable(message));
}

/// The exit code of a program that has done its work: 1 if what it printed could not be written, as on a full
/// disk.
int finished(const CLI::App& program)
{
    errno = 0;
    if (std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0)
        return 0;
    print_error(
        program,
        fmt::format(
            "standard output: cannot be written: {}; check where it goes, and that the disk has space",
            std::strerror(errno != 0 ? errno : EIO)));
    return 1;
}

/// When the kernel made this process, in seconds since 1970; now if /proc cannot be read.
double process_start(double now)
{
    // proc(5): field 22 is the start time in clock ticks since boot; the name in field 2 may contain blanks.
    std::string stat;
    std::getline(std::ifstream("/proc/self/stat"), stat);
    std::istringstream fields(stat.substr(std::min(stat.rfind(')') + 2, stat.size())));
    std::string field;
    for (int i = 3; i < 22; ++i)
        fields >> field;
    double ticks = 0;
    timespec boot{};
    if (!(fields >> ticks) || ::clock_gettime(CLOCK_BOOTTIME, &boot) != 0)
        return now;
    const double up = double(boot.tv_sec) + 1e-9 * double(boot.tv_nsec);
    return now - up + ticks / double(::sysconf(_SC_CLK_TCK));
}

} // namespace

double ms_since_start()
{
    using namespace std::chrono;
    const double now = duration<double>(system_clock::now().time_since_epoch()).count();
    const char* handed_over = std::getenv("CICATRIX_STARTED");
    // A number from before this process is a leftover in the environment of its parent, or no number.
    const double start = std::max(process_start(now), handed_over ? std::strtod(handed_over, nullptr) : 0.);
    return 1e3 * std::max(0., now - start);
}

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
        if (error.get_exit_code() == 0) { // --help
            program.exit(error);
            return finished(program);
        }
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
    return finished(program);
}

} // namespace base
