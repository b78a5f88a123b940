// Compares two reports: ratios of times with their intervals, and which of them exceed the noise.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/statistics.hpp"

namespace report_command {

struct ComparedTime
{
    std::string where;                  // the case
    std::string what;                   // a pass, or "frame"
    double before_ms = 0, after_ms = 0; // medians
    base::RatioInterval ratio;          // after / before
    double drift = 1;                   // the larger drift_of() of the two runs
    bool exceeds_noise = false;
};

struct Comparison
{
    std::string against;               // the earlier report's file
    std::vector<std::string> warnings; // other differences: device, driver, size, scene ...
    std::vector<ComparedTime> times;
};

/// Reads an earlier report. Throws base::InputError when the file is not a report or has another version.
nlohmann::json read_report(const std::filesystem::path& path);

/// Compares every case and pass that ran in both. A difference exceeds the noise when the interval of its
/// ratio, at a level of 5 % for all comparisons together (Bonferroni), lies outside 1/drift..drift, where
/// drift is the larger ratio between the halves of either run.
Comparison compare_reports(const nlohmann::json& before, const nlohmann::json& after,
                           const std::filesystem::path& against);

std::string to_text(const Comparison& comparison);

} // namespace report_command
