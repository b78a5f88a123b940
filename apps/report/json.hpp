// The machine-readable parts of a report: report.json (docs/report.md documents every field) and trace.json.
#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/report/summary.hpp"

namespace report_command {

/// `facts`: an object with program, device, machine, settings and scene; its fields precede "cases".
nlohmann::json report_json(const nlohmann::json& facts, const std::vector<CaseSummary>& summaries,
                           const std::vector<stage::Measurement>& measurements);

/// Chrome's trace event format, for Perfetto and chrome://tracing: a process per case with a CPU and a GPU
/// track, times in microseconds since the first measured frame.
nlohmann::json trace_json(const nlohmann::json& facts, const std::vector<stage::Measurement>& measurements);

nlohmann::json to_json(const base::Spread& spread);
template <typename T>
nlohmann::json to_json(const std::optional<T>& value)
{
    return value ? to_json(*value) : nlohmann::json(nullptr);
}

} // namespace report_command
