#include "apps/demo_events.hpp"

#include "wound/input_error.hpp"

namespace app {

DemoEvents::DemoEvents(const std::filesystem::path& file)
{
    if (file.empty())
        return;
    stream_.open(file);
    if (!stream_)
        throw cicatrix::InputError(file.string(), "cannot be written", "name another file with --events");
}

void DemoEvents::tell(const std::string& event, nlohmann::json details)
{
    if (!stream_.is_open())
        return;
    details["event"] = event;
    stream_ << details.dump() << std::endl;
}

} // namespace app
