// report.html: one self-contained page without scripts or external files, for light and dark colour schemes.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/report/comparison.hpp"
#include "apps/report/summary.hpp"

namespace report_command {

std::string report_page(const nlohmann::json& facts, const std::vector<CaseSummary>& summaries,
                        const std::vector<stage::Measurement>& measurements,
                        const std::optional<Comparison>& comparison);

} // namespace report_command
