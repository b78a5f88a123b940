// Shows the progress of long work in one terminal line: count, percentage, time left. Prints nothing when
// stderr is not a terminal. show() also handles Ctrl-C.
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

#include "base/interrupt.hpp"

namespace base {

class Progress
{
  public:
    /// Prints to stderr if `shown` is true and stderr is a terminal.
    explicit Progress(bool shown = true);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Adds to the number of expected steps.
    void expect(std::size_t steps) { expected_ += steps; }
    /// Shows what is being done. Throws Interrupted after Ctrl-C.
    void show(const std::string& what);
    /// Counts one step as done.
    void step();
    /// Removes the line, so that other text can be printed; the next show() prints it again.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    Interruptible interruptible_;
    const bool terminal_;
    const Clock::time_point start_ = Clock::now();
    Clock::time_point shown_{};
    std::size_t expected_ = 0, done_ = 0;
};

/// The line without terminal codes: "day 3   12 of 96   12 %   1:05 left". The time left appears once one
/// step is done.
std::string progress_text(const std::string& what, std::size_t done, std::size_t expected, double elapsed_s);

} // namespace base
