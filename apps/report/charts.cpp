#include "apps/report/charts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

#include "base/chart.hpp"

namespace report_command {
namespace {

using graph::PassState;
namespace palette = base::palette;

constexpr double width = 960, row_height = 26; // px

/// Renders the chart as SVG for the page.
std::string page_svg(const base::Chart& chart)
{
    const double plot = row_height * double(chart.y.rows.size());
    return base::chart_svg(chart, {width, base::chart_height(chart, width, plot)}, base::SvgUse::InPage);
}

} // namespace

PassColors::PassColors(const std::vector<CaseSummary>& summaries)
{
    std::vector<std::pair<double, std::string>> found;
    for (const CaseSummary& summary : summaries)
        for (const PassSummary& pass : summary.passes) {
            const auto known = std::ranges::find(found, pass.name, &std::pair<double, std::string>::second);
            if (known == found.end())
                found.emplace_back(pass.share, pass.name);
            else
                known->first = std::max(known->first, pass.share);
        }
    std::ranges::stable_sort(found, std::ranges::greater{}, &std::pair<double, std::string>::first);
    for (const auto& [share, name] : found)
        names_.push_back(name);
}

base::Paint PassColors::of(const std::string& pass) const
{
    return base::series_paint(std::size_t(std::ranges::find(names_, pass) - names_.begin()));
}

std::string stacked_bars(const std::vector<CaseSummary>& summaries, const PassColors& colors)
{
    base::Chart chart{.description = "Where the frame time of each case goes",
                      .x = {.title = "median frame", .unit = "ms", .low = 0}};
    for (const std::string& pass : colors.passes())
        chart.legend.push_back({pass, colors.of(pass)});
    chart.legend.push_back({"outside the passes", palette::rest});
    double most = 0;
    for (const CaseSummary& summary : summaries) {
        const double row = double(chart.y.rows.size());
        chart.y.rows.push_back(summary.name);
        most = std::max(most, summary.wall_ms.median);
        double from = 0;
        const auto add = [&](const std::string& name, double share, base::Paint paint) {
            const double ms = share * summary.wall_ms.median;
            chart.bars.push_back(
                {row, from, from + ms, paint, fmt::format("{}: {:.2f} ms, {:.1f} %", name, ms, 100 * share)});
            from += ms;
        };
        for (const PassSummary& pass : summary.passes)
            if (pass.share > 0)
                add(pass.name, pass.share, colors.of(pass.name));
        add("outside the passes", 1 - summary.coverage, palette::rest);
        chart.bars.back().label = fmt::format("{:.1f}", summary.wall_ms.median);
    }
    chart.x.high = 1.08 * most; // room for the label
    return page_svg(chart);
}

std::string distributions(const CaseSummary& summary, const stage::Measurement& measurement,
                          const PassColors& colors)
{
    base::Chart chart{.description = "Every frame's time of each pass",
                      .x = {.title = "all frames, median, p5 to p95", .unit = "ms", .logarithmic = true}};
    const auto add = [&](const std::string& name, const std::vector<double>& times, base::Paint paint) {
        const double row = double(chart.y.rows.size());
        chart.y.rows.push_back(name);
        base::Series frames{.paint = paint, .radius = 2.2, .opacity = .55};
        for (const double ms : times) // vertical offsets keep equal times visible
            frames.points.emplace_back(std::max(ms, least_drawn_ms),
                                       row + .25 * std::sin(double(frames.points.size()) * 2.399));
        chart.series.push_back(std::move(frames));
        const base::Spread spread = base::spread_of(times).value();
        const double median = std::max(spread.median, least_drawn_ms);
        chart.series.push_back(
            {.points = {{median, row}}, .x_spread = {{std::max(spread.p5, least_drawn_ms), spread.p95}}});
        chart.series.push_back({.points = {{median, row - .3}, {median, row + .3}}, .line_width = 2.4});
    };
    add("frame", stage::wall_ms(measurement), palette::rest);
    for (const PassSummary& pass : summary.passes)
        if (pass.ran > 0)
            add(pass.name, stage::pass_ms(measurement, pass.name), colors.of(pass.name));
    return page_svg(chart);
}

std::string timeline(const stage::TimedFrame& frame, const PassColors& colors)
{
    enum Row
    {
        cpu,
        gpu,
    };
    base::Chart chart{
        .description = "CPU and GPU during one frame",
        .x = {.title = "time since the start of the frame", .unit = "ms", .low = 0, .high = frame.wall_ms()},
        .y = {.rows = {"CPU", "GPU"}}};
    const auto add = [&](Row row, const std::string& name, double begin, double ms, base::Paint paint,
                         double opacity = 1) {
        chart.bars.push_back({.row = double(row),
                              .from = begin,
                              .to = begin + ms,
                              .paint = paint,
                              .tooltip = fmt::format("{}: {:.3f} ms from {:.3f}", name, ms, begin),
                              .opacity = opacity});
    };
    add(cpu, "declaring the frame", 0, frame.declare_ms, palette::rest);
    double at = frame.declare_ms;
    const auto& host = frame.result.host;
    for (const auto& [name, ms, opacity] : {std::tuple("checking and scheduling", host.schedule_ms, 0.7),
                                            {"recording", host.record_ms, 0.5},
                                            {"submitting", host.submit_ms, 0.8},
                                            {"waiting for the GPU", host.wait_ms, 0.2},
                                            {"fetching the picture", host.readback_ms, 0.7}})
    {
        add(cpu, name, at, ms, palette::rest, opacity);
        at += ms;
    }
    for (const auto& pass : frame.result.passes) {
        if (pass.state != PassState::Run)
            continue;
        add(cpu, pass.name + ", recorded", frame.declare_ms + pass.cpu_begin_ms, pass.cpu_ms,
            colors.of(pass.name));
        if (pass.gpu_ms)
            add(gpu, pass.name, frame.declare_ms + *pass.gpu_begin_ms, *pass.gpu_ms, colors.of(pass.name));
    }
    if (const auto& copy = frame.result.copy)
        add(gpu, "copying the picture out", frame.declare_ms + copy->begin_ms, copy->ms, palette::rest);
    return page_svg(chart);
}

std::string ratios(const Comparison& comparison)
{
    base::Chart chart{
        .description = "Ratios of this run to the earlier one",
        .x = {.title = "ratio of medians, this run / earlier run, with interval", .logarithmic = true},
        .references = {{base::ReferenceLine::Along::Y, 1, "", palette::ink, 1.5}}};
    double least = 0.8, most = 1.25;
    for (const ComparedTime& time : comparison.times) {
        const double row = double(chart.y.rows.size());
        const base::Paint paint = !time.exceeds_noise    ? palette::rest
                                  : time.ratio.ratio > 1 ? palette::slower
                                                         : palette::faster;
        chart.y.rows.push_back(time.where + ": " + time.what);
        chart.series.push_back({.paint = paint,
                                .points = {{time.ratio.ratio, row}},
                                .radius = 4.5,
                                .x_spread = {{time.ratio.low, time.ratio.high}}});
        least = std::min(least, time.ratio.low / 1.05);
        most = std::max(most, time.ratio.high * 1.05);
    }
    chart.x.low = least;
    chart.x.high = most;
    return page_svg(chart);
}

} // namespace report_command
