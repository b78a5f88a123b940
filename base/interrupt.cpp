#include "base/interrupt.hpp"

#include <array>
#include <csignal>
#include <mutex>

namespace base {
namespace {

volatile std::sig_atomic_t noted = 0;
std::mutex mutex;
int living = 0;
constexpr std::array signals{SIGINT, SIGTERM};
std::array<struct sigaction, signals.size()> before;

} // namespace

Interruptible::Interruptible()
{
    const std::lock_guard lock(mutex);
    if (living++ > 0)
        return;
    struct sigaction action = {};
    action.sa_handler = [](int) { noted = 1; };
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        sigaction(signals[i], nullptr, &before[i]);
        if (before[i].sa_handler != SIG_IGN) // as under nohup
            sigaction(signals[i], &action, nullptr);
    }
}

Interruptible::~Interruptible()
{
    const std::lock_guard lock(mutex);
    if (--living > 0)
        return;
    for (std::size_t i = 0; i < signals.size(); ++i)
        sigaction(signals[i], &before[i], nullptr);
    noted = 0;
}

void check_interrupt()
{
    if (noted != 0)
        throw Interrupted();
}

} // namespace base
