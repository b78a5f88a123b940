#include "apps/report/charts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/svg.hpp"

namespace report_command {
namespace {

using graph::PassState;

constexpr double width = 960, left = 180, right = 40, row = 26;
constexpr const char *grid = "var(--grid)", *rest = "var(--rest)", *ink = "currentColor";

/// 1, 2 or 5 times a power of ten, so that about six ticks fit.
double tick_step(double range)
{
    const double power = std::pow(10, std::floor(std::log10(range / 6)));
    for (const double step : {1., 2., 5.})
        if (step * power >= range / 6)
            return step * power;
    return 10 * power;
}

/// Milliseconds from 0 to `most` along x.
struct LinearAxis
{
    double most;
    double at(double ms) const { return left + ms / most * (width - left - right); }
    void draw(base::Svg& svg, double top, double bottom) const
    {
        const double step = tick_step(most);
        for (double tick = 0; tick <= most * 1.0001; tick += step) {
            svg.line(at(tick), top, at(tick), bottom, grid);
            svg.text(at(tick), bottom + 16, fmt::format("{:g}", tick), "middle", "var(--faint)");
        }
        svg.text(width - 4, bottom + 16, "ms", "end", "var(--faint)");
    }
};

struct LogAxis
{
    double least, most;
    double at(double value) const
    {
        return left + std::log(std::clamp(value, least, most) / least) / std::log(most / least) *
                          (width - left - right);
    }
    void draw(base::Svg& svg, double top, double bottom, const std::vector<double>& steps,
              std::string_view unit) const
    {
        for (double power = std::pow(10, std::floor(std::log10(least))); power <= most; power *= 10)
            for (const double step : steps)
                if (const double tick = step * power; tick >= least * 0.999 && tick <= most * 1.001) {
                    svg.line(at(tick), top, at(tick), bottom, grid);
                    svg.text(at(tick), bottom + 16, fmt::format("{:g}", tick), "middle", "var(--faint)");
                }
        svg.text(width - 4, bottom + 16, unit, "end", "var(--faint)");
    }
};

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

std::string PassColors::of(const std::string& pass) const
{
    constexpr std::ptrdiff_t colors = 10;
    const auto at = std::ranges::find(names_, pass) - names_.begin();
    return fmt::format("var(--c{})", at % colors);
}

std::string stacked_bars(const std::vector<CaseSummary>& summaries, const PassColors& colors)
{
    double most = 0;
    for (const CaseSummary& summary : summaries)
        most = std::max(most, summary.wall_ms.median);
    const LinearAxis axis{1.15 * most};
    const double legend = 24 * std::ceil(double(colors.passes().size() + 1) / 4),
                 bottom = legend + 12 + 1.5 * row * double(summaries.size());
    base::Svg svg(width, bottom + 24, "Where the frame time of each case goes");
    for (std::size_t i = 0; i <= colors.passes().size(); ++i) {
        const double x = 10 + 235 * double(i % 4), y = 16 + 24 * std::floor(double(i) / 4);
        const bool pass = i < colors.passes().size();
        svg.rect(x, y - 10, 12, 12, pass ? colors.of(colors.passes()[i]) : rest);
        svg.text(x + 18, y, pass ? colors.passes()[i] : "outside the passes");
    }
    axis.draw(svg, legend + 4, bottom);
    double y = legend + 12;
    for (const CaseSummary& summary : summaries) {
        svg.text(left - 10, y + 16, summary.name, "end");
        double from = 0;
        const auto segment = [&](const std::string& name, double share, std::string_view fill) {
            const double ms = share * summary.wall_ms.median;
            svg.rect(axis.at(from), y, axis.at(ms) - axis.at(0), row - 4, fill,
                     fmt::format("{}: {:.2f} ms, {:.1f} %", name, ms, 100 * share));
            from += ms;
        };
        for (const PassSummary& pass : summary.passes)
            if (pass.share > 0)
                segment(pass.name, pass.share, colors.of(pass.name));
        segment("outside the passes", 1 - summary.coverage, rest);
        svg.text(axis.at(from) + 6, y + 16, fmt::format("{:.1f}", summary.wall_ms.median));
        y += 1.5 * row;
    }
    return svg.finished();
}

std::string distributions(const CaseSummary& summary, const stage::Measurement& measurement,
                          const PassColors& colors)
{
    std::vector<std::pair<std::string, std::vector<double>>> rows{{"frame", stage::wall_ms(measurement)}};
    for (const PassSummary& pass : summary.passes)
        if (pass.ran > 0)
            rows.emplace_back(pass.name, stage::pass_ms(measurement, pass.name));
    double least = 1e9, most = 0;
    for (const auto& [name, times] : rows)
        for (const double ms : times) {
            least = std::min(least, std::max(ms, 1e-4));
            most = std::max(most, ms);
        }
    const LogAxis axis{least / 1.2, std::max(1.2 * most, 2 * least)};
    const double bottom = 8 + row * double(rows.size());
    base::Svg svg(width, bottom + 24, "Every frame's time of each pass");
    axis.draw(svg, 4, bottom, most / least > 300 ? std::vector{1.} : std::vector{1., 2., 5.}, "ms");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& [name, times] = rows[i];
        const double y = 8 + row * (double(i) + 0.5);
        const std::string color = i == 0 ? rest : colors.of(name);
        svg.text(left - 10, y + 4, name, "end");
        for (std::size_t n = 0; n < times.size();
             ++n) // spread out, so that equal ones do not hide each other
            svg.circle(axis.at(times[n]), y + 6 * std::sin(double(n) * 2.399), 2.2, color, 0.55);
        const base::Spread spread = base::spread_of(times).value();
        svg.line(axis.at(spread.p5), y, axis.at(spread.p95), y, ink, 1.2);
        svg.line(axis.at(spread.median), y - 8, axis.at(spread.median), y + 8, ink, 2.4);
    }
    return svg.finished();
}

std::string timeline(const stage::TimedFrame& frame, const PassColors& colors)
{
    const gpu::FrameResult& result = frame.result;
    const LinearAxis axis{frame.wall_ms()};
    constexpr double cpu = 8, gpu = 8 + 1.4 * row, bottom = 8 + 2.8 * row;
    base::Svg svg(width, bottom + 24, "CPU and GPU in the course of one frame");
    axis.draw(svg, 4, bottom);
    svg.text(left - 10, cpu + 16, "CPU", "end");
    svg.text(left - 10, gpu + 16, "GPU", "end");
    const auto bar = [&](double y, const std::string& name, double begin, double ms, std::string_view fill,
                         double opacity = 1) {
        svg.rect(axis.at(begin), y, axis.at(ms) - axis.at(0), row - 4, fill,
                 fmt::format("{}: {:.3f} ms from {:.3f}", name, ms, begin), opacity);
    };
    bar(cpu, "declaring the frame", 0, frame.declare_ms, rest);
    double at = frame.declare_ms;
    const gpu::HostTimes& host = result.host;
    for (const auto& [name, ms, opacity] : {std::tuple("checking and scheduling", host.schedule_ms, 0.7),
                                            {"recording", host.record_ms, 0.5},
                                            {"submitting", host.submit_ms, 0.8},
                                            {"waiting for the GPU", host.wait_ms, 0.2},
                                            {"fetching the picture", host.readback_ms, 0.7}})
    {
        bar(cpu, name, at, ms, rest, opacity);
        at += ms;
    }
    for (const gpu::PassResult& pass : result.passes) {
        if (pass.state != PassState::Run)
            continue;
        bar(cpu, pass.name + ", recorded", frame.declare_ms + pass.cpu_begin_ms, pass.cpu_ms,
            colors.of(pass.name));
        if (pass.gpu_ms)
            bar(gpu, pass.name, frame.declare_ms + *pass.gpu_begin_ms, *pass.gpu_ms, colors.of(pass.name));
    }
    if (result.copy)
        bar(gpu, "copying the picture out", frame.declare_ms + result.copy->begin_ms, result.copy->ms, rest);
    return svg.finished();
}

std::string ratios(const Comparison& comparison)
{
    double least = 0.8, most = 1.25;
    for (const ComparedTime& time : comparison.times) {
        least = std::min(least, time.ratio.low / 1.05);
        most = std::max(most, time.ratio.high * 1.05);
    }
    const LogAxis axis{least, most};
    const double bottom = 8 + row * double(comparison.times.size());
    base::Svg svg(width, bottom + 24, "Ratios of this run to the earlier one");
    axis.draw(svg, 4, bottom,
              most / least < 3 ? std::vector{1., 1.1, 1.2, 1.5, 2., 5., 6., 7., 8., 9.}
                               : std::vector{1., 2., 5.},
              "ratio");
    svg.line(axis.at(1), 4, axis.at(1), bottom, ink, 1.5);
    for (std::size_t i = 0; i < comparison.times.size(); ++i) {
        const ComparedTime& time = comparison.times[i];
        const double y = 8 + row * (double(i) + 0.5);
        const char* color = !time.exceeds_noise    ? rest
                            : time.ratio.ratio > 1 ? "var(--slower)"
                                                   : "var(--faster)";
        svg.text(left - 10, y + 4, time.where + ": " + time.what, "end");
        svg.line(axis.at(time.ratio.low), y, axis.at(time.ratio.high), y, color, 2);
        svg.circle(axis.at(time.ratio.ratio), y, 4.5, color);
    }
    return svg.finished();
}

} // namespace report_command
