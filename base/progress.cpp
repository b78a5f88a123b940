#include "base/progress.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unistd.h>

namespace base {
namespace {

std::string duration_text(double seconds)
{
    const auto whole = static_cast<long>(std::ceil(seconds));
    return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                        : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

} // namespace

Progress::Progress(bool shown) : terminal_(shown && ::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress()
{
    clear();
}

void Progress::show(const std::string& what)
{
    check_interrupt();
    const Clock::time_point now = Clock::now();
    if (!terminal_ || now - shown_ < std::chrono::milliseconds(100)) // terminals are slow
        return;
    shown_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    fmt::print(stderr, "\r\033[K{}", progress_text(what, done_, expected_, elapsed));
}

void Progress::step()
{
    ++done_;
}

void Progress::clear()
{
    if (terminal_ && shown_ != Clock::time_point{})
        fmt::print(stderr, "\r\033[K");
    shown_ = {};
}

std::string progress_text(const std::string& what, std::size_t done, std::size_t expected, double elapsed_s)
{
    std::string text = what;
    if (expected > 1) {
        text += fmt::format("   {} of {}   {} %", std::min(done + 1, expected), expected,
                            100 * std::min(done, expected) / expected);
        if (done > 0 && done < expected)
            text +=
                fmt::format("   {} left", duration_text(elapsed_s / double(done) * double(expected - done)));
    }
    return text;
}

} // namespace base
