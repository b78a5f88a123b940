// Reads a table of measured wound areas (CSV) into series of ratios to the first day.
//
// Columns, by the start of their names, in any order and case: day; area or ratio (several of them, one for
// each reader, are averaged); optionally wound (a name: one series for each), weight (a number >= 0), and
// edge or quality (words: a row all of whose readers wrote "imagined", "bad" or 0 is left out). Separator
// comma, semicolon or tab; decimal commas where the separator is none; without a header the first two columns
// are day and area. Empty cells and NA are measurements not made.
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
};

/// One series for each wound, in order of first appearance. Throws cicatrix::InputError naming file, line and
/// column.
std::vector<AreaSeries> read_area_table(const std::filesystem::path& file);
std::vector<AreaSeries> read_area_table(std::istream& text, std::string_view where);

/// What the mean over several wounds is: of their ratios, each wound its own measure, or the mean area of
/// those measured on a day over the mean area of all on their first: then a day on which a large wound was
/// missed looks healed.
enum class MeanOf
{
    ratios,
    areas
};

/// The mean over series on every day on which at least one was measured, named "mean".
AreaSeries mean_series(const std::vector<AreaSeries>& series, MeanOf of = MeanOf::ratios);

} // namespace wound
