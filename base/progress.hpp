// One line on a terminal that says how far long work is: count, percentage, time left. On anything else than
// a terminal it says nothing. Where it is told of progress, Ctrl-C is heeded.
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

#include "base/interrupt.hpp"

namespace base {

class Progress
{
  public:
    /// Shown on stderr, when that is a terminal and `shown`.
    explicit Progress(bool shown = true);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// So many more steps are ahead.
    void expect(std::size_t steps) { expected_ += steps; }
    /// What is being done, and that a step of it is done. show() throws Interrupted after Ctrl-C.
    void show(const std::string& what);
    void step();
    /// Takes the line away, so that something else can be printed; the next show() puts it back.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    Interruptible interruptible_;
    const bool terminal_;
    const Clock::time_point start_ = Clock::now();
    Clock::time_point shown_{};
    std::size_t expected_ = 0, done_ = 0;
};

/// The line without its terminal codes: "day 3   12 of 96   12 %   1:05 left". The time left is told once
/// something is done.
std::string progress_text(const std::string& what, std::size_t done, std::size_t expected, double elapsed_s);

} // namespace base
