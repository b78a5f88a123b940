// The output of a sweep: text, JSON and chart.
#include <algorithm>
#include <fmt/format.h>
#include <set>

#include "apps/report/charts.hpp"
#include "apps/report/json.hpp"
#include "apps/report/sweep.hpp"

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

base::Chart sweep_chart(const Sweep& sweep, const std::string& device)
{
    base::Chart chart{.title = fmt::format("ms against {}", sweep.x_label),
                      .x = {.title = sweep.x_label, .logarithmic = true},
                      .y = {.title = "median, p5 to p95", .unit = "ms", .logarithmic = true},
                      .legend_place = base::LegendPlace::Right,
                      .footnote = device};
    for (const SweepSeries& series : sweep.series) {
        const base::Paint paint = base::series_paint(chart.series.size() / 2);
        base::Series medians{
            .legend = series.name + "\n" + law_text(series.law, "x"), .paint = paint, .radius = 4};
        base::Series law{.paint = paint, .line_width = 1};
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            medians.points.emplace_back(series.x[i], series.ms[i].median);
            medians.y_spread.push_back({std::max(series.ms[i].p5, least_drawn_ms), series.ms[i].p95});
            if (series.law && series.x[i] > 0)
                law.points.emplace_back(series.x[i], series.law->at(series.x[i]));
        }
        chart.series.push_back(std::move(law));
        chart.series.push_back(std::move(medians));
    }
    return chart;
}

} // namespace report_command
