// The charts of a report's page, as elements of it.
#pragma once
#include <string>
#include <vector>

#include "apps/report/comparison.hpp"
#include "apps/report/summary.hpp"
#include "base/palette.hpp"

namespace report_command {

/// The colour of a pass in all charts of a report.
class PassColors
{
  public:
    explicit PassColors(const std::vector<CaseSummary>& summaries);
    base::Paint of(const std::string& pass) const;
    const std::vector<std::string>& passes() const { return names_; }

  private:
    std::vector<std::string> names_; // the dearest first
};

/// A bar per case: what its median frame consists of.
std::string stacked_bars(const std::vector<CaseSummary>& summaries, const PassColors& colors);
/// A row per pass: every frame's time, the median and what lies between p5 and p95, on a logarithmic axis.
std::string distributions(const CaseSummary& summary, const stage::Measurement& measurement,
                          const PassColors& colors);
/// The CPU and the GPU in the course of one frame.
std::string timeline(const stage::TimedFrame& frame, const PassColors& colors);
/// Ratios and their intervals.
std::string ratios(const Comparison& comparison);

} // namespace report_command
