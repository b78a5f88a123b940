// Ctrl-C in the midst of long work: nothing half-made is left behind.
#pragma once

namespace base {

/// Thrown by check_interrupt(). No std::exception: whoever goes on after an error must not go on after this.
struct Interrupted
{
};

/// While one lives, the first SIGINT or SIGTERM only leaves a note, which check_interrupt() finds; the next
/// ends the process at once, as ever.
class Interruptible
{
  public:
    Interruptible();
    ~Interruptible();
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;
};

/// Throws Interrupted when a signal has come.
void check_interrupt();

} // namespace base
