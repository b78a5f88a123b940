#include "base/interrupt.hpp"

#include <array>
#include <csignal>
#include <mutex>

namespace base {
namespace {

volatile std::sig_atomic_t interrupted = 0;
std::mutex mutex;
int instances = 0;
constexpr std::array signals{SIGINT, SIGTERM};
std::array<struct sigaction, signals.size()> before;

} // namespace

Interruptible::Interruptible()
{
    const std::lock_guard lock(mutex);
    if (instances++ > 0)
        return;
    struct sigaction action = {};
    action.sa_handler = [](int) { interrupted = 1; };
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        sigaction(signals[i], nullptr, &before[i]);
        if (before[i].sa_handler != SIG_IGN) // nohup ignores signals; keep it so
            sigaction(signals[i], &action, nullptr);
    }
}

Interruptible::~Interruptible()
{
    const std::lock_guard lock(mutex);
    if (--instances > 0)
        return;
    for (std::size_t i = 0; i < signals.size(); ++i)
        sigaction(signals[i], &before[i], nullptr);
    interrupted = 0;
}

void check_interrupt()
{
    if (interrupted != 0)
        throw Interrupted();
}

} // namespace base
