#include "apps/demo/events.hpp"

#include <sstream>
#include <time.h>
#include <unistd.h>

#include "base/input_error.hpp"

namespace demo_command {
namespace {

/// ms since the kernel created this process, before main() and the loading of libraries; resolution 10 ms.
double since_start_ms()
{
    // proc(5): field 22 is the start time in clock ticks since boot; the name in field 2 may contain blanks.
    std::string stat;
    std::getline(std::ifstream("/proc/self/stat"), stat);
    std::istringstream fields(stat.substr(std::min(stat.rfind(')') + 2, stat.size())));
    std::string field;
    for (int i = 3; i < 22; ++i)
        fields >> field;
    double ticks = 0;
    fields >> ticks;
    timespec now{};
    ::clock_gettime(CLOCK_BOOTTIME, &now);
    return 1e3 * (double(now.tv_sec) - ticks / double(::sysconf(_SC_CLK_TCK))) + 1e-6 * double(now.tv_nsec);
}

} // namespace

DemoEvents::DemoEvents(const std::filesystem::path& file)
{
    if (file.empty())
        return;
    stream_.open(file);
    if (!stream_)
        throw base::InputError(file.string(), "cannot be written", "name another file with --events");
}

void DemoEvents::tell(const std::string& event, nlohmann::json details)
{
    if (!stream_.is_open())
        return;
    details["event"] = event;
    details["ms"] = since_start_ms();
    stream_ << details.dump() << std::endl;
}

} // namespace demo_command
