// The chart writer. A Chart describes the content; it is drawn as SVG, in a page or as a file, or as a
// picture, with the same result: round ticks, a legend outside the plot, point names that do not overlap.
// Nothing is drawn outside the axes' ranges; values that an axis cannot show (NaN, infinity, <= 0 on a
// logarithmic axis) are skipped.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/axis.hpp"
#include "base/canvas.hpp"

namespace base {

struct Interval
{
    double low = 0, high = 0;
};

enum class Path : std::uint8_t
{
    Straight,
    Staircase, // horizontal to the next point's x, then vertical to that point
};

/// Points with their line, dots and spread. Later series are drawn over earlier ones.
struct Series
{
    std::string legend; // text in the legend; empty: no entry
    Paint paint = palette::ink;
    std::vector<cv::Point2d> points;
    double line_width = 0; // px; 0: no line. A point that cannot be drawn interrupts the line
    Path path = Path::Straight;
    double radius = 0;              // px, of each point's dot; 0: no dots
    double opacity = 1;             // of the dots
    std::vector<std::string> names; // labels and tooltips of the dots: none, or one per point
    std::vector<Interval>
        y_spread; // vertical bars through the points, such as p5 to p95: none, or one per point
    std::vector<Interval> x_spread; // the same, horizontal
    bool band = false;              // draw y_spread as one filled area instead of bars
};

/// A horizontal bar in one row of a y axis with rows.
struct Bar
{
    double row = 0, from = 0, to = 0;
    Paint paint = palette::rest;
    std::string tooltip;
    std::string label; // written right of the bar
    double opacity = 1;
};

struct ReferenceLine
{
    enum class Along : std::uint8_t
    {
        X, // horizontal, at a y
        Y, // vertical, at an x
    };
    Along along = Along::X;
    double at = 0;
    std::string name; // written beside the line
    Paint paint = palette::faint;
    double width = 1; // px
};

struct LegendEntry
{
    std::string text; // a newline begins a second line
    Paint paint = palette::ink;
    double line_width = 0, radius = 0; // px, of the sample; both 0: a square
};

enum class LegendPlace : std::uint8_t
{
    Above,
    Right,
};

struct Chart
{
    std::string title;
    std::string description; // for screen readers; empty: the title
    Axis x, y;
    std::vector<Bar> bars;
    std::vector<ReferenceLine> references;
    std::vector<Series> series;
    LegendPlace legend_place = LegendPlace::Above;
    std::vector<LegendEntry> legend; // additional entries after those of the series
    std::string footnote;
};

/// `area` includes the titles and labels. Several charts may share a canvas.
void draw_chart(Canvas& canvas, const cv::Rect2d& area, const Chart& chart);
/// Height in pixels of a whole chart with a plot (the area between the axes) of `plot_height` pixels.
double chart_height(const Chart& chart, double width, double plot_height);
/// Draws only a legend, with one entry per row.
void draw_legend(Canvas& canvas, const cv::Rect2d& area, const std::vector<LegendEntry>& entries);

std::string chart_svg(const Chart& chart, cv::Size2d size, SvgUse use);
/// The background is white.
cv::Mat3b chart_picture(const Chart& chart, cv::Size size);

} // namespace base
