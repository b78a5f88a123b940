// Reads a table of measured wound areas (CSV) into series of ratios to the first day.
//
// Columns, by the start of their names, in any order and case: day; area or ratio (several of them, one for
// each reader, are averaged); optionally wound (a name: one series for each), group (wounds to be averaged;
// without the column the part of the wound's name before its first '-'), weight (a number >= 0), and edge or
// quality (words: a row all of whose readers wrote "imagined", "bad" or 0 is left out). Separator comma,
// semicolon or tab; decimal commas where the separator is none; without a header the first two columns are
// day and area. Empty cells and NA are measurements not made.
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
    int left_out = 0;            // rows whose readers all found them unreliable, or of weight 0
};

/// One series for each wound, in order of first appearance. Throws base::InputError naming file, line and
/// column.
std::vector<AreaSeries> read_area_table(const std::filesystem::path& file);
std::vector<AreaSeries> read_area_table(std::istream& text, std::string_view where);

/// What the mean over several wounds is: the mean area of those measured on a day over the mean area of all
/// on their first, or the mean of their ratios, each wound its own measure.
enum class MeanOf
{
    Areas,
    Ratios
};

/// The mean over series on every day on which at least one was measured, named "mean".
AreaSeries mean_series(const std::vector<AreaSeries>& series, MeanOf of = MeanOf::Areas);

/// "mean GROUP" for every group of two wounds or more, in order of first appearance; none when all wounds are
/// of one group.
std::vector<AreaSeries> group_means(const std::vector<AreaSeries>& series, MeanOf of = MeanOf::Areas);

} // namespace wound
