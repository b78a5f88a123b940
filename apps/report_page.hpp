// report.html: one page with everything in it, no scripts, nothing fetched; readable in light and dark.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/report_compare.hpp"
#include "apps/report_summary.hpp"

namespace app {

std::string report_page(const nlohmann::json& facts, const std::vector<CaseSummary>& summaries,
                        const std::vector<Measurement>& measurements,
                        const std::optional<Comparison>& comparison);

} // namespace app
