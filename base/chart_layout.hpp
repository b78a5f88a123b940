// Computes the position of every part of a chart; base/chart.cpp draws the parts.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/chart.hpp"

namespace base {

inline constexpr double text_height = 9;   // px, of a capital letter in a chart
inline constexpr double line_height = 17;  // px, from line to line
inline constexpr double sample_width = 26; // px, of a legend entry's sample including the gap to its text

struct Label
{
    std::string text;
    cv::Point2d at; // the anchor, on the baseline
    TextStyle style;
};

struct PlacedEntry
{
    LegendEntry entry;
    std::vector<std::string> lines; // of the entry's text
    cv::Point2d at;                 // left end of the sample, on the baseline of the first line
};

struct ChartLayout
{
    cv::Rect2d plot; // between the axes
    Scale x, y;
    std::vector<Tick> x_ticks, y_ticks;
    std::vector<Label> labels; // tick labels, titles and footnote
    std::vector<PlacedEntry> legend;
};

ChartLayout lay_out(const Chart& chart, const cv::Rect2d& area);

/// The centre of the pixel that contains `at`: a 1 px line there is sharp.
double crisp(double at);

/// LegendPlace::Above: as many columns as fit in `area`; LegendPlace::Right: one column.
std::vector<PlacedEntry> place_entries(const std::vector<LegendEntry>& entries, const cv::Rect2d& area,
                                       LegendPlace place);

} // namespace base
