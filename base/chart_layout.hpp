// Where everything of a chart lies, before anything is drawn: base/chart.cpp draws it.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/chart.hpp"

namespace base {

inline constexpr double text_height = 9;   // px, of a capital letter in a chart
inline constexpr double line_height = 17;  // px, from line to line
inline constexpr double sample_width = 26; // px, of a legend entry's sample with the gap behind it

struct Label
{
    std::string text;
    cv::Point2d at; // its anchor, on the base line
    TextStyle style;
};

struct PlacedEntry
{
    LegendEntry entry;
    std::vector<std::string> lines; // of its text
    cv::Point2d at;                 // left end of its sample, on the base line of its first line
};

struct ChartLayout
{
    cv::Rect2d plot; // between the axes
    Scale x, y;
    std::vector<Tick> x_ticks, y_ticks;
    std::vector<Label> labels; // of the ticks; titles and footnote
    std::vector<PlacedEntry> legend;
};

ChartLayout lay_out(const Chart& chart, const cv::Rect2d& area);

/// The middle of the pixel in which `at` lies: a line there is crisp.
double crisp(double at);

/// In columns as many as fit, or below each other.
std::vector<PlacedEntry> place_entries(const std::vector<LegendEntry>& entries, const cv::Rect2d& area,
                                       LegendPlace place);

} // namespace base
