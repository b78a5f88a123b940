// A log of the window's events, one JSON object per line, for tests that drive the window: they wait for an
// event instead of a time.
#pragma once
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace demo_command {

class DemoEvents
{
  public:
    /// An empty path writes nothing. Throws base::InputError when the file cannot be written.
    explicit DemoEvents(const std::filesystem::path& file);

    bool wanted() const { return stream_.is_open(); }
    /// Adds "event" and "ms" (base::ms_since_start()) to `details`; flushes at once.
    void tell(const std::string& event, nlohmann::json details = nlohmann::json::object());

  private:
    std::ofstream stream_;
};

} // namespace demo_command
