// The one chart writer. A Chart says what is to be seen; it is drawn as SVG, inside a page or as a file, or
// as a picture, the same on each: round ticks, a legend that hides no data, names beside points that do not
// overlap. Nothing is drawn outside the axes' ranges, and what has no place on an axis (NaN, infinity, zero
// on a logarithmic one) is left out.
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
    Staircase, // level up to the next point's x, then up or down to it
};

/// Points and what is drawn through and around them; later series lie over earlier ones.
struct Series
{
    std::string legend; // empty: not in the legend
    Paint paint = palette::ink;
    std::vector<cv::Point2d> points;
    double line_width = 0; // px; 0: no line. A point without a place interrupts the line
    Path path = Path::Straight;
    double radius = 0;              // px, of each point's dot; 0: no dots
    double opacity = 1;             // of the dots
    std::vector<std::string> names; // beside the dots, and their tooltips: none, or one per point
    std::vector<Interval>
        y_spread; // a vertical bar through each point, such as p5 to p95: none, or one per point
    std::vector<Interval> x_spread; // the same, horizontal
    bool band = false;              // y_spread as one area instead
};

/// Lies along x in a row of an axis with rows.
struct Bar
{
    double row = 0, from = 0, to = 0;
    Paint paint = palette::rest;
    std::string tooltip;
    std::string label; // behind its end
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
    std::string name; // written beside it
    Paint paint = palette::faint;
    double width = 1; // px
};

struct LegendEntry
{
    std::string text; // a newline begins a second line
    Paint paint = palette::ink;
    double line_width = 0, radius = 0; // px, of its sample; without both, a square
};

enum class LegendPlace : std::uint8_t
{
    Above,
    Right,
};

struct Chart
{
    std::string title;
    std::string description; // for those who cannot see it; empty: the title
    Axis x, y;
    std::vector<Bar> bars;
    std::vector<ReferenceLine> references;
    std::vector<Series> series;
    LegendPlace legend_place = LegendPlace::Above;
    std::vector<LegendEntry> legend; // after those of the series
    std::string footnote;
};

/// `area`: of the chart with its titles and labels. Several charts may share a canvas.
void draw_chart(Canvas& canvas, const cv::Rect2d& area, const Chart& chart);
/// Of the whole chart, for a plot of `plot_height` pixels between the axes.
double chart_height(const Chart& chart, double width, double plot_height);
/// A legend alone, one entry below the other.
void draw_legend(Canvas& canvas, const cv::Rect2d& area, const std::vector<LegendEntry>& entries);

std::string chart_svg(const Chart& chart, cv::Size2d size, SvgUse use);
/// On white.
cv::Mat3b chart_picture(const Chart& chart, cv::Size size);

} // namespace base
