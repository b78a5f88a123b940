// The machine a measurement was made on and the program that made it, without names of hosts or users: fit to
// be attached to a bug.
#pragma once
#include <nlohmann/json_fwd.hpp>

namespace base {

/// cpu, cores, memory_gib, memory_free_gib, os, kernel; what cannot be found out is null.
nlohmann::json machine_json();

/// version, build ("release", "debug"), sanitizers, compiler.
nlohmann::json program_json();

/// Processes that were ready to run in the last minute, all programs together; 0 where it cannot be told.
double load_average();

} // namespace base
