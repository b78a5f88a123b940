// Reads a table of measured wound areas (CSV) into series of ratios to the first day.
//
// Columns are recognised by the start of their names, in any order and case: day; area or ratio (several
// columns, one per reader, are averaged); optionally wound (a name; one series each), group (wounds to
// average; default: the wound's name up to its first '-'), weight (a number >= 0), and edge or quality (a row
// is left out if all of these are "imagined", "bad" or 0). The separator is comma, semicolon or tab; decimal
// commas are allowed unless it is a comma. Without a header the two columns are day and area. Empty cells and
// NA are missing measurements.
#pragma once
#include <filesystem>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace wound {

struct AreaSeries
{
    std::string name;            // of the wound; "wound" when the table names none
    std::vector<double> days;    // ascending, distinct; the first measured day is day 0
    std::vector<double> ratios;  // area / area on the first day
    std::vector<double> weights; // of each day's ratio, > 0
    double initial_area = 1;     // on the first day, in the table's unit; 1 where the table holds ratios
    std::string group = {};      // of the wound; empty for the mean of all
    int left_out = 0;            // rows that all readers marked as unreliable, or of weight 0
};

/// One series for each wound, in order of first appearance. Throws base::InputError naming file, line and
/// column.
std::vector<AreaSeries> read_area_table(const std::filesystem::path& file);
std::vector<AreaSeries> read_area_table(std::istream& text, std::string_view where);

/// The mean over several wounds on one day.
enum class MeanOf
{
    Areas, // mean area of the wounds measured that day / mean first-day area of all wounds
    Ratios // mean of the wounds' ratios
};

/// The mean over the series, named "mean", on every day on which at least one was measured.
AreaSeries mean_series(const std::vector<AreaSeries>& series, MeanOf of = MeanOf::Areas);

/// "mean GROUP" for every group of two wounds or more, in order of first appearance; none when all wounds are
/// of one group.
std::vector<AreaSeries> group_means(const std::vector<AreaSeries>& series, MeanOf of = MeanOf::Areas);

} // namespace wound
