// The charts of a report's page, as SVG elements.
#pragma once
#include <string>
#include <vector>

#include "apps/report/comparison.hpp"
#include "apps/report/summary.hpp"
#include "base/palette.hpp"

namespace report_command {

inline constexpr double least_drawn_ms = 1e-4; // smaller times are drawn here: zero has no logarithm

/// Assigns each pass one colour for all charts of a report.
class PassColors
{
  public:
    explicit PassColors(const std::vector<CaseSummary>& summaries);
    base::Paint of(const std::string& pass) const;
    const std::vector<std::string>& passes() const { return names_; }

  private:
    std::vector<std::string> names_; // the most expensive first
};

/// One bar per case: the median frame, divided into passes.
std::string stacked_bars(const std::vector<CaseSummary>& summaries, const PassColors& colors);
/// One row per pass: the time in every frame, the median and the range p5 to p95, on a logarithmic axis.
std::string distributions(const CaseSummary& summary, const stage::Measurement& measurement,
                          const PassColors& colors);
/// CPU and GPU work during one frame.
std::string timeline(const stage::TimedFrame& frame, const PassColors& colors);
/// Ratios of this run to the earlier run, with intervals.
std::string ratios(const Comparison& comparison);

} // namespace report_command
