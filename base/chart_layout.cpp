#include "base/chart_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace base {
namespace {

constexpr double border = 8;             // px, margin around the chart
constexpr double title_height = 10;      // px, of a title's capitals
constexpr double tick_gap = 6;           // px, between a tick's label and the plot
constexpr double title_gap = 11;         // px, between the y axis' title and the plot
constexpr double least_left = 48;        // px, so that the plots of stacked charts align
constexpr double least_plot = 16;        // px
constexpr double x_gap = 44, y_gap = 20; // px, between the labels of neighbouring ticks
constexpr double column_gap = 20;        // px, of the legend
constexpr double data_margin = .05;      // of the range, on either side of the data

/// Truncates `text` with "..." when it is wider than `width` pixels.
std::string fitted(std::string text, double width, double height = text_height)
{
    if (text_width(text, height) <= width)
        return text;
    while (!text.empty() && text_width(text + "...", height) > width)
        text.pop_back();
    return text + "...";
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

/// Breaks `text` between words into lines of at most `width` pixels; empty text gives no lines.
std::vector<std::string> wrapped(const std::string& text, double width, double height)
{
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (lines.empty() || text_width(lines.back() + " " + word, height) > width)
            lines.push_back(word);
        else
            lines.back() += " " + word;
        begin = end + 1;
    }
    for (std::string& line : lines)
        line = fitted(std::move(line), width, height);
    return lines;
}

std::string title_of(const Axis& axis)
{
    return axis.title + (axis.title.empty() || axis.unit.empty() ? "" : ", ") + axis.unit;
}

// ---- The legend

double width_of(const LegendEntry& entry)
{
    double width = 0;
    for (const std::string& line : lines_of(entry.text))
        width = std::max(width, text_width(line, text_height));
    return sample_width + width;
}

struct LegendGrid
{
    std::size_t columns = 1, rows = 0;
    double column_width = 0, row_height = 0; // px

    LegendGrid(const std::vector<LegendEntry>& entries, double width, LegendPlace place)
    {
        double widest = 0;
        std::size_t lines = 1;
        for (const LegendEntry& entry : entries) {
            widest = std::max(widest, width_of(entry));
            lines = std::max(lines, lines_of(entry.text).size());
        }
        if (place == LegendPlace::Above)
            columns = std::size_t(std::max(1., std::floor((width + column_gap) / (widest + column_gap))));
        rows = (entries.size() + columns - 1) / columns;
        column_width = std::min(widest, width) + column_gap;
        row_height = line_height * double(lines) + (lines > 1 ? 3 : 0);
    }
    double height() const { return row_height * double(rows); }
};

std::vector<LegendEntry> legend_of(const Chart& chart)
{
    std::vector<LegendEntry> entries;
    for (const Series& series : chart.series)
        if (!series.legend.empty())
            entries.push_back({series.legend, series.paint, series.line_width, series.radius});
    entries.insert(entries.end(), chart.legend.begin(), chart.legend.end());
    return entries;
}

// ---- The axes' ranges

/// The values along one axis that its range must include.
std::vector<double> values_along(const Chart& chart, bool x)
{
    std::vector<double> values;
    for (const Series& series : chart.series) {
        for (const cv::Point2d& p : series.points)
            values.push_back(x ? p.x : p.y);
        for (const Interval& spread : x ? series.x_spread : series.y_spread)
            values.insert(values.end(), {spread.low, spread.high});
    }
    for (const Bar& bar : chart.bars)
        if (x)
            values.insert(values.end(), {bar.from, bar.to});
    for (const ReferenceLine& line : chart.references)
        if ((line.along == ReferenceLine::Along::Y) == x)
            values.push_back(line.at);
    return values;
}

Scale scale_of(const Chart& chart, bool x)
{
    const Axis& axis = x ? chart.x : chart.y;
    if (!axis.rows.empty())
        return {-.5, double(axis.rows.size()) - .5};
    Scale scale{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                axis.logarithmic};
    for (const double value : values_along(chart, x))
        if (std::isfinite(value) && (!axis.logarithmic || value > 0)) {
            scale.low = std::min(scale.low, value);
            scale.high = std::max(scale.high, value);
        }
    scale.low = axis.low.value_or(scale.low);
    scale.high = axis.high.value_or(scale.high);
    scale = widened(scale);
    const double low = scale.low, high = scale.high, added = data_margin * (high - low),
                 factor = std::pow(high / low, data_margin);
    if (!axis.low)
        scale.low = axis.logarithmic ? low / factor : low - added;
    if (!axis.high)
        scale.high = axis.logarithmic ? high * factor : high + added;
    return scale;
}

// ---- Layout

/// The margins around the plot; those above and below depend only on the chart's content and width.
struct Margins
{
    std::vector<std::string> title, footnote; // lines
    std::vector<LegendEntry> legend;
    LegendGrid grid;
    double above = border, below = border + line_height, right = 2 * border; // px

    Margins(const Chart& chart, double width)
        : title(wrapped(chart.title, width - 2 * border, title_height)),
          footnote(wrapped(chart.footnote, width - 2 * border, text_height)), legend(legend_of(chart)),
          grid(legend, chart.legend_place == LegendPlace::Above ? width - 2 * border : width / 2,
               chart.legend_place)
    {
        above += line_height * double(title.size());
        above += title_of(chart.y).empty() ? 0 : line_height + title_gap - tick_gap;
        below += line_height * double(footnote.size()) + (title_of(chart.x).empty() ? 0 : line_height);
        if (chart.legend_place == LegendPlace::Above)
            above += grid.height() + (legend.empty() ? 0 : border);
        else if (!legend.empty())
            right = grid.column_width + border + sample_width / 2;
    }
};

std::vector<Tick> ticks_of_rows(const std::vector<std::string>& rows, const Scale& scale, double width)
{
    std::vector<Tick> ticks;
    for (std::size_t i = 0; i < rows.size(); ++i)
        ticks.push_back({double(i), *scale.at(double(i)), fitted(rows[i], width)});
    return ticks;
}

void place_axes(ChartLayout& layout, const Chart& chart, const cv::Rect2d& area, const Margins& margins)
{
    const double top = crisp(area.y + margins.above),
                 bottom = std::max(crisp(area.y + area.height - margins.below), top + least_plot);
    const bool rows = !chart.y.rows.empty();
    layout.y = scale_of(chart, false);
    layout.y.begin = rows ? top : bottom;
    layout.y.end = rows ? bottom : top;
    layout.y_ticks = rows ? ticks_of_rows(chart.y.rows, layout.y, area.width / 3)
                          : round_ticks(
                                layout.y, [](const std::string&) { return text_height; }, y_gap);
    double left = least_left;
    for (const Tick& tick : layout.y_ticks)
        left = std::max(left, border + text_width(tick.label, text_height) + tick_gap);
    layout.x = scale_of(chart, true);
    layout.x.begin = crisp(area.x + left);
    layout.x.end = std::max(crisp(area.x + area.width - margins.right), layout.x.begin + least_plot);
    layout.plot = {layout.x.begin, top, layout.x.end - layout.x.begin, bottom - top};
    layout.x_ticks = round_ticks(
        layout.x, [](const std::string& label) { return text_width(label, text_height); }, x_gap);
}

void place_labels(ChartLayout& layout, const Chart& chart, const cv::Rect2d& area, const Margins& margins)
{
    const double left = area.x + border, bottom = layout.plot.y + layout.plot.height;
    for (std::size_t i = 0; i < margins.title.size(); ++i)
        layout.labels.push_back({margins.title[i],
                                 {left, area.y + border + title_height + line_height * double(i)},
                                 {palette::ink, title_height}});
    if (!title_of(chart.y).empty())
        layout.labels.push_back({fitted(title_of(chart.y), area.width - 2 * border),
                                 {left, layout.plot.y - title_gap},
                                 {palette::ink, text_height}});
    const Paint y_paint = chart.y.rows.empty() ? palette::faint : palette::ink;
    for (const Tick& tick : layout.y_ticks)
        layout.labels.push_back({tick.label,
                                 {layout.plot.x - tick_gap, tick.at + text_height / 2},
                                 {y_paint, text_height, Anchor::End}});
    double base_line = bottom + tick_gap + text_height;
    for (const Tick& tick : layout.x_ticks) {
        const double half = text_width(tick.label, text_height) / 2;
        const double at =
            std::clamp(tick.at, area.x + half, std::max(area.x + half, area.x + area.width - half));
        layout.labels.push_back({tick.label, {at, base_line}, {palette::faint, text_height, Anchor::Middle}});
    }
    if (!title_of(chart.x).empty())
        layout.labels.push_back({fitted(title_of(chart.x), layout.plot.width),
                                 {layout.plot.x + layout.plot.width / 2, base_line += line_height},
                                 {palette::ink, text_height, Anchor::Middle}});
    for (const std::string& line : margins.footnote)
        layout.labels.push_back({line, {left, base_line += line_height}, {palette::faint, text_height}});
}

} // namespace

double crisp(double at)
{
    return std::floor(at) + .5;
}

std::vector<PlacedEntry> place_entries(const std::vector<LegendEntry>& entries, const cv::Rect2d& area,
                                       LegendPlace place)
{
    const LegendGrid grid(entries, area.width, place);
    std::vector<PlacedEntry> placed;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        PlacedEntry entry{entries[i], lines_of(entries[i].text), {}};
        for (std::string& line : entry.lines)
            line = fitted(std::move(line), area.width - sample_width);
        entry.at = {area.x + grid.column_width * double(i % grid.columns),
                    area.y + text_height + grid.row_height * double(i / grid.columns)};
        placed.push_back(std::move(entry));
    }
    return placed;
}

ChartLayout lay_out(const Chart& chart, const cv::Rect2d& area)
{
    const Margins margins(chart, area.width);
    ChartLayout layout;
    place_axes(layout, chart, area, margins);
    place_labels(layout, chart, area, margins);
    const bool above = chart.legend_place == LegendPlace::Above;
    const cv::Point2d corner =
        above ? cv::Point2d(area.x + border,
                            area.y + border + line_height * double(margins.title.size()) + border / 2)
              : cv::Point2d(area.x + area.width - margins.right + sample_width / 2, layout.plot.y);
    const double width = above ? area.width - 2 * border : margins.right - border - sample_width / 2;
    layout.legend = place_entries(margins.legend, {corner, cv::Size2d(width, 0)}, chart.legend_place);
    return layout;
}

double chart_height(const Chart& chart, double width, double plot_height)
{
    const Margins margins(chart, width);
    return margins.above + std::max(plot_height, least_plot) + margins.below;
}

} // namespace base
