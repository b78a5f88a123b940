// Stops long work at Ctrl-C by an exception, so that no incomplete files are left.
#pragma once

namespace base {

/// Thrown by check_interrupt(). Not a std::exception, so that code which continues after errors does not
/// catch it.
struct Interrupted
{
};

/// While an instance exists, the first SIGINT or SIGTERM only sets a flag for check_interrupt(); the second
/// ends the process at once.
class Interruptible
{
  public:
    Interruptible();
    ~Interruptible();
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;
};

/// Throws Interrupted when a signal has arrived.
void check_interrupt();

} // namespace base
