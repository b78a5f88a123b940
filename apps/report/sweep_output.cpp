// What a sweep looks like: as text, as JSON, as a plot.
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

#include "apps/report/json.hpp"
#include "apps/report/sweep.hpp"
#include "base/plot.hpp"

namespace report_command {
namespace {
using nlohmann::json;

std::string law_text(const std::optional<base::PowerLaw>& law, const std::string& x)
{
    return law ? fmt::format("{}^({:.2f} +- {:.2f})", x, law->exponent, law->standard_error)
               : std::string("no fit");
}

} // namespace

std::string to_text(const Sweep& sweep)
{
    std::string text = fmt::format("{}: ms against {}\nfixed: {}\n", sweep.kind, sweep.x_label, sweep.fixed);
    std::set<double> all;
    for (const SweepSeries& series : sweep.series)
        all.insert(series.x.begin(), series.x.end());
    text += fmt::format("  {:<44}", "median ms");
    for (const double x : all)
        text += fmt::format(" {:>9.0f}", x);
    text += "  grows as\n";
    for (const SweepSeries& series : sweep.series) {
        text += fmt::format("  {:<44}", series.name);
        for (const double x : all) {
            const auto at = std::ranges::find(series.x, x) - series.x.begin();
            text += at == std::ssize(series.x) ? fmt::format(" {:>9}", "-")
                                               : fmt::format(" {:9.3f}", series.ms[std::size_t(at)].median);
        }
        text += "  " + law_text(series.law, "x") + "\n";
    }
    return text;
}

json to_json(const Sweep& sweep)
{
    json list = json::array();
    for (const SweepSeries& series : sweep.series) {
        json law = nullptr, ms = json::array();
        if (series.law)
            law = {{"exponent", series.law->exponent},
                   {"standard_error", series.law->standard_error},
                   {"factor", series.law->factor},
                   {"points", series.law->points}};
        for (const base::Spread& spread : series.ms)
            ms.push_back(to_json(spread));
        list.push_back({{"name", series.name}, {"x", series.x}, {"ms", ms}, {"power_law", law}});
    }
    return {{"kind", sweep.kind}, {"x_label", sweep.x_label}, {"fixed", sweep.fixed}, {"series", list}};
}

cv::Mat3b draw_sweep(const Sweep& sweep, const gpu::DeviceInfo& device)
{
    constexpr std::array<std::array<int, 3>, 9> colors{{{181, 71, 47},
                                                        {47, 111, 181},
                                                        {61, 143, 77},
                                                        {138, 86, 176},
                                                        {201, 138, 18},
                                                        {23, 138, 138},
                                                        {194, 84, 155},
                                                        {119, 112, 31},
                                                        {90, 90, 90}}};
    base::Range x{1e300, 0, true}, y{1e300, 0, true};
    for (const SweepSeries& series : sweep.series)
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            if (series.x[i] <= 0)
                continue; // a logarithm has no place for it
            x.low = std::min(x.low, series.x[i] / 1.1);
            x.high = std::max(x.high, series.x[i] * 1.1);
            y.low = std::min(y.low, std::max(series.ms[i].p5, 1e-4) / 1.2);
            y.high = std::max(y.high, series.ms[i].p95 * 1.2);
        }
    constexpr int chart = 470, width = 800, height = 380, legend_row = 35;
    cv::Mat3b picture(height, width, cv::Vec3b(255, 255, 255));
    base::Plot plot(picture, {0, 0, chart, height}, x, y, fmt::format("ms against {}", sweep.x_label),
                    sweep.x_label);
    base::draw_text(picture, device.name, {chart + 8, 20}, {90, 90, 90}, 0.85);
    if (device.software)
        base::draw_text(picture, "a software rasteriser", {chart + 8, 36}, {90, 90, 90}, 0.85);
    int line = 60;
    for (std::size_t s = 0; s < sweep.series.size(); ++s) {
        const SweepSeries& series = sweep.series[s];
        const auto& rgb = colors[s % colors.size()];
        const cv::Scalar color(rgb[0], rgb[1], rgb[2]);
        std::vector<cv::Point2d> medians;
        for (std::size_t i = 0; i < series.x.size(); ++i)
            if (series.x[i] > 0) {
                medians.emplace_back(series.x[i], series.ms[i].median);
                plot.line({{series.x[i], series.ms[i].p5}, {series.x[i], series.ms[i].p95}}, color, 1);
            }
        plot.points(medians, color);
        if (series.law && !medians.empty())
            plot.line({{medians.front().x, series.law->at(medians.front().x)},
                       {medians.back().x, series.law->at(medians.back().x)}},
                      color, 1);
        base::draw_text(picture, series.name, {chart + 8, line}, color, 0.95);
        base::draw_text(picture, law_text(series.law, "x"), {chart + 24, line + 16}, color, 0.85);
        line += legend_row;
    }
    return picture;
}

} // namespace report_command
