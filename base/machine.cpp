#include "base/machine.hpp"

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/utsname.h>
#include <thread>

namespace base {
namespace {
using nlohmann::json;

/// The value after `key` in the first line of `file` that starts with it, without surrounding blanks, colons,
/// equals signs and quotes; null when there is no such line.
json line_after(const char* file, const std::string& key)
{
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with(key))
            continue;
        const auto from = line.find_first_not_of(" \t:=\"", key.size());
        const auto to = line.find_last_not_of(" \t\"");
        return from == std::string::npos ? json(nullptr) : json(line.substr(from, to - from + 1));
    }
    return nullptr;
}

json gib(const json& kib)
{
    return kib.is_string() ? json(std::strtod(kib.get<std::string>().c_str(), nullptr) / (1 << 20))
                           : json(nullptr);
}

} // namespace

json machine_json()
{
    utsname kernel{};
    const bool known = ::uname(&kernel) == 0;
    return {{"cpu", line_after("/proc/cpuinfo", "model name")},
            {"cores", std::thread::hardware_concurrency()},
            {"memory_gib", gib(line_after("/proc/meminfo", "MemTotal"))},
            {"memory_free_gib", gib(line_after("/proc/meminfo", "MemAvailable"))},
            {"os", line_after("/etc/os-release", "PRETTY_NAME")},
            {"kernel", known ? json(std::string(kernel.sysname) + " " + kernel.release) : json(nullptr)}};
}

json program_json()
{
#ifdef NDEBUG
    constexpr const char* build = "release";
#else
    constexpr const char* build = "debug";
#endif
#ifdef __SANITIZE_ADDRESS__
    constexpr bool sanitizers = true;
#else
    constexpr bool sanitizers = false;
#endif
#ifdef __clang__
    constexpr const char* compiler = __VERSION__;
#else
    constexpr const char* compiler = "GCC " __VERSION__;
#endif
    return {
        {"version", CICATRIX_VERSION}, {"build", build}, {"sanitizers", sanitizers}, {"compiler", compiler}};
}

double load_average()
{
    double minutes[1] = {0};
    return ::getloadavg(minutes, 1) == 1 ? minutes[0] : 0;
}

} // namespace base
