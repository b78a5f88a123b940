// Describes the machine and the program of a measurement, without host or user names, so that the description
// can be attached to a bug report.
#pragma once
#include <nlohmann/json_fwd.hpp>

namespace base {

/// cpu, cores, memory_gib, memory_free_gib, os, kernel; an unknown value is null.
nlohmann::json machine_json();

/// version, build ("release", "debug"), sanitizers, compiler.
nlohmann::json program_json();

/// The system's load average over the last minute; 0 when it is unknown.
double load_average();

} // namespace base
