#include "base/chart.hpp"

#include <algorithm>
#include <cmath>

#include "base/chart_layout.hpp"
#include "base/label_placement.hpp"

namespace base {
namespace {

constexpr double bar_share = .85; // of a row's height
constexpr double band_opacity = .2;
constexpr double spread_width = 1.2; // px
constexpr double name_clearance = 4; // px, between a dot and its name
constexpr double far = 24;           // px: a name farther from its dot is connected to it by a line
constexpr double descent = .35;      // depth of letters below the baseline, relative to a capital's height

cv::Size2d label_size(const std::string& text)
{
    return {text_width(text, text_height), (1 + descent) * text_height + 2};
}

cv::Point2d baseline_start(const cv::Rect2d& label)
{
    return {label.x, label.y + text_height + 1};
}

void draw_sample(Canvas& canvas, const PlacedEntry& placed)
{
    const LegendEntry& entry = placed.entry;
    constexpr double width = sample_width - 8;
    const cv::Point2d middle = placed.at + cv::Point2d(width / 2, -std::round(text_height / 2) + .5);
    if (entry.line_width > 0)
        canvas.line(middle - cv::Point2d(width / 2, 0), middle + cv::Point2d(width / 2, 0),
                    {entry.paint, entry.line_width});
    if (entry.radius > 0)
        canvas.circle(middle, entry.radius, {entry.paint});
    if (entry.line_width <= 0 && entry.radius <= 0)
        canvas.rect({middle.x - 3, middle.y - 5.5, 11, 11}, {entry.paint});
}

void draw_entries(Canvas& canvas, const std::vector<PlacedEntry>& entries)
{
    for (const PlacedEntry& placed : entries) {
        draw_sample(canvas, placed);
        cv::Point2d at = placed.at + cv::Point2d(sample_width, 0);
        for (const std::string& line : placed.lines) {
            canvas.text(at, line, {palette::ink, text_height});
            at.y += line_height;
        }
    }
}

/// Draws one chart layer by layer, clipped to the plot.
class ChartDrawing
{
  public:
    ChartDrawing(Canvas& canvas, const cv::Rect2d& area, const Chart& chart)
        : canvas_(canvas), chart_(chart), layout_(lay_out(chart, area)), names_(layout_.plot)
    {
    }

    void draw()
    {
        draw_frame();
        for (const Bar& bar : chart_.bars)
            draw_bar(bar);
        for (const ReferenceLine& line : chart_.references)
            draw_reference(line);
        for (const Series& series : chart_.series)
            draw_series(series);
        draw_names();
        for (const Label& label : layout_.labels)
            canvas_.text(label.at, label.text, label.style);
        draw_entries(canvas_, layout_.legend);
    }

  private:
    std::optional<cv::Point2d> place(cv::Point2d value) const
    {
        const auto x = layout_.x.at(value.x), y = layout_.y.at(value.y);
        return x && y ? std::optional(cv::Point2d(*x, *y)) : std::nullopt;
    }
    /// The pixel of `value`; none when it lies outside the plot.
    std::optional<cv::Point2d> visible(cv::Point2d value) const
    {
        const auto at = place(value);
        return at && clipped({*at, *at}, layout_.plot) ? at : std::nullopt;
    }

    void draw_frame();
    void draw_bar(const Bar& bar);
    void draw_reference(const ReferenceLine& line);
    void draw_series(const Series& series);
    void draw_band(const Series& series);
    void draw_path(const std::vector<cv::Point2d>& values, const Stroke& stroke);
    void draw_names();
    void draw_name(const std::string& name, Paint paint, const std::vector<cv::Rect2d>& candidates,
                   std::optional<cv::Point2d> point);

    Canvas& canvas_;
    const Chart& chart_;
    const ChartLayout layout_;
    LabelPlacement names_;
};

void ChartDrawing::draw_frame()
{
    const cv::Rect2d& plot = layout_.plot;
    const double right = plot.x + plot.width, bottom = plot.y + plot.height;
    for (const Tick& tick : layout_.x_ticks)
        canvas_.line({crisp(tick.at), plot.y}, {crisp(tick.at), bottom}, {palette::grid});
    if (chart_.y.rows.empty())
        for (const Tick& tick : layout_.y_ticks)
            canvas_.line({plot.x, crisp(tick.at)}, {right, crisp(tick.at)}, {palette::grid});
    canvas_.line({plot.x, plot.y}, {plot.x, bottom}, {palette::faint});
    canvas_.line({plot.x, bottom}, {right, bottom}, {palette::faint});
}

void ChartDrawing::draw_bar(const Bar& bar)
{
    const auto from = place({bar.from, bar.row}), to = place({bar.to, bar.row});
    if (!from || !to)
        return;
    const auto inside = clipped({*from, *to}, layout_.plot);
    if (!inside)
        return;
    const double half = bar_share / 2 * std::abs(*layout_.y.at(1) - *layout_.y.at(0));
    const auto [left, right] = std::minmax(inside->from.x, inside->to.x);
    canvas_.rect({left, from->y - half, right - left, 2 * half}, {bar.paint, bar.opacity}, bar.tooltip);
    if (bar.label.empty())
        return;
    const double most = layout_.plot.x + layout_.plot.width - text_width(bar.label, text_height);
    canvas_.text({std::min(right + 6, most), from->y + text_height / 2}, bar.label,
                 {palette::ink, text_height});
}

void ChartDrawing::draw_reference(const ReferenceLine& line)
{
    const cv::Rect2d& plot = layout_.plot;
    const bool level = line.along == ReferenceLine::Along::X;
    const auto at = (level ? layout_.y : layout_.x).at(line.at);
    if (!at)
        return;
    const cv::Point2d from = level ? cv::Point2d(plot.x, *at) : cv::Point2d(*at, plot.y),
                      to = level ? cv::Point2d(plot.x + plot.width, *at)
                                 : cv::Point2d(*at, plot.y + plot.height);
    if (!clipped({from, to}, plot))
        return;
    canvas_.line(from, to, {line.paint, line.width});
    names_.rather_not_cover({from, to});
}

void ChartDrawing::draw_path(const std::vector<cv::Point2d>& values, const Stroke& stroke)
{
    std::vector<cv::Point2d> run;
    const auto finish = [&] {
        if (run.size() > 1)
            canvas_.polyline(run, stroke);
        run.clear();
    };
    for (std::size_t i = 1; i < values.size(); ++i) {
        const auto from = place(values[i - 1]), to = place(values[i]);
        const auto inside = from && to ? clipped({*from, *to}, layout_.plot) : std::nullopt;
        if (!inside || (!run.empty() && run.back() != inside->from))
            finish();
        if (!inside)
            continue;
        names_.rather_not_cover(*inside);
        if (run.empty())
            run.push_back(inside->from);
        run.push_back(inside->to);
    }
    finish();
}

void ChartDrawing::draw_band(const Series& series)
{
    std::vector<cv::Point2d> outline;
    const auto add = [&](double x, double y) {
        if (auto at = place({x, y})) {
            at->x = std::clamp(at->x, layout_.plot.x, layout_.plot.x + layout_.plot.width);
            at->y = std::clamp(at->y, layout_.plot.y, layout_.plot.y + layout_.plot.height);
            outline.push_back(*at);
        }
    };
    for (std::size_t i = 0; i < series.y_spread.size(); ++i)
        add(series.points[i].x, series.y_spread[i].high);
    for (std::size_t i = series.y_spread.size(); i-- > 0;)
        add(series.points[i].x, series.y_spread[i].low);
    if (outline.size() > 2)
        canvas_.polygon(outline, {series.paint, band_opacity});
}

void ChartDrawing::draw_series(const Series& series)
{
    if (series.band)
        draw_band(series);
    else
        for (std::size_t i = 0; i < series.y_spread.size(); ++i)
            draw_path(
                {{series.points[i].x, series.y_spread[i].low}, {series.points[i].x, series.y_spread[i].high}},
                {series.paint, spread_width});
    for (std::size_t i = 0; i < series.x_spread.size(); ++i)
        draw_path(
            {{series.x_spread[i].low, series.points[i].y}, {series.x_spread[i].high, series.points[i].y}},
            {series.paint, spread_width});
    if (series.line_width > 0) {
        std::vector<cv::Point2d> corners;
        for (const cv::Point2d& p : series.points) {
            if (series.path == Path::Staircase && !corners.empty())
                corners.emplace_back(p.x, corners.back().y);
            corners.push_back(p);
        }
        draw_path(corners, {series.paint, series.line_width});
    }
    if (series.radius <= 0)
        return;
    for (std::size_t i = 0; i < series.points.size(); ++i)
        if (const auto at = visible(series.points[i])) {
            const double r = series.radius;
            if (series.names.empty())
                names_.rather_not_cover({*at, *at});
            else
                names_.never_cover({at->x - r, at->y - r, 2 * r, 2 * r});
            canvas_.circle(*at, r, {series.paint, series.opacity},
                           series.names.empty() ? std::string() : series.names[i]);
        }
}

void ChartDrawing::draw_name(const std::string& name, Paint paint, const std::vector<cv::Rect2d>& candidates,
                             std::optional<cv::Point2d> point)
{
    const auto label = names_.place(candidates);
    if (!label)
        return; // a missing name is better than overlapping names
    if (point) {
        const cv::Point2d near(std::clamp(point->x, label->x, label->x + label->width),
                               std::clamp(point->y, label->y, label->y + label->height));
        if (cv::norm(near - *point) > far)
            canvas_.line(*point, near, {palette::rest, .8});
    }
    canvas_.text(baseline_start(*label), name, {paint, text_height});
}

/// Candidate label positions on both sides of a reference line, from its right or top end on.
std::vector<cv::Rect2d> places_along(const ReferenceLine& line, const Scale& scale, const cv::Rect2d& plot)
{
    constexpr int steps = 12;
    const cv::Size2d size = label_size(line.name);
    const double at = *scale.at(line.at);
    std::vector<cv::Rect2d> places;
    for (int i = 0; i <= steps; ++i) {
        const double share = double(i) / steps, x = plot.x + plot.width - size.width,
                     y = plot.y + share * (plot.height - size.height);
        for (const bool after : {false, true})
            if (line.along == ReferenceLine::Along::X)
                places.emplace_back(cv::Point2d(x - share * (plot.width - size.width) - 2,
                                                after ? at + 2 : at - size.height - 1),
                                    size);
            else
                places.emplace_back(cv::Point2d(after ? at - size.width - 4 : at + 4, y), size);
    }
    return places;
}

void ChartDrawing::draw_names()
{
    for (const ReferenceLine& line : chart_.references) {
        const Scale& scale = line.along == ReferenceLine::Along::X ? layout_.y : layout_.x;
        if (!line.name.empty() && scale.at(line.at))
            draw_name(line.name, line.paint, places_along(line, scale, layout_.plot), std::nullopt);
    }
    for (const Series& series : chart_.series)
        for (std::size_t i = 0; i < series.names.size(); ++i)
            if (const auto at = visible(series.points[i]); at && !series.names[i].empty())
                draw_name(series.names[i], palette::ink,
                          places_around(*at, series.radius + name_clearance, label_size(series.names[i])),
                          at);
}

} // namespace

void draw_chart(Canvas& canvas, const cv::Rect2d& area, const Chart& chart)
{
    ChartDrawing(canvas, area, chart).draw();
}

void draw_legend(Canvas& canvas, const cv::Rect2d& area, const std::vector<LegendEntry>& entries)
{
    draw_entries(canvas, place_entries(entries, area, LegendPlace::Right));
}

std::string chart_svg(const Chart& chart, cv::Size2d size, SvgUse use)
{
    SvgCanvas canvas(size, chart.description.empty() ? chart.title : chart.description, use);
    draw_chart(canvas, {0, 0, size.width, size.height}, chart);
    return canvas.finished();
}

cv::Mat3b chart_picture(const Chart& chart, cv::Size size)
{
    cv::Mat3b picture(size, rgb_of(palette::white));
    PictureCanvas canvas(picture);
    draw_chart(canvas, {0, 0, double(size.width), double(size.height)}, chart);
    return picture;
}

} // namespace base
