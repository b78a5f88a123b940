#include "apps/demo/events.hpp"

#include "base/input_error.hpp"
#include "base/program.hpp"

namespace demo_command {
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
    details["ms"] = base::ms_since_start();
    stream_ << details.dump() << std::endl;
}

} // namespace demo_command
