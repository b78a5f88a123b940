#include "apps/figure/frame_rate.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/figure/figures.hpp"
#include "apps/figure/workbench.hpp"
#include "base/chart.hpp"
#include "base/machine.hpp"
#include "base/statistics.hpp"
#include "stage/cost.hpp"

namespace figure_command {
namespace {
using nlohmann::json;

constexpr double playable_fps = 60, shown_day = 10, interval_misses = .05;
constexpr std::array<PaperRate, 7> rates{{{"Ward's BRDF [15]", 115.5, "115-116"},
                                          {"layered Oren-Nayar BRDF [24]", 115.5, "115-116"},
                                          {"proposed", 114, "114"},
                                          {"Wang's BSSRDF [9]", 31.8, "at most 31.8"},
                                          {"Shah's image space [10]", 31, "31"},
                                          {"Chang's texture space [25]", 20, "at most 20"},
                                          {"Li's hybrid Monte Carlo [16]", 10, "10"}}};

base::Chart paper_chart()
{
    base::Chart chart{
        .title = "The paper: GeForce GTX 580",
        .x = {.title = "frames per second; the line: 60, which games need [17]", .low = 0, .high = 150},
        .references = {{base::ReferenceLine::Along::Y, playable_fps}}};
    for (const PaperRate& rate : rates) {
        const double row = double(chart.y.rows.size());
        chart.y.rows.push_back(rate.system);
        const bool proposed = std::string_view(rate.system) == "proposed";
        chart.bars.push_back({.row = row,
                              .from = 0,
                              .to = rate.fps,
                              .paint = base::series_paint(proposed ? 0 : 1),
                              .label = rate.words});
    }
    return chart;
}

base::Chart our_chart(const json& record)
{
    base::Chart chart{.title = fmt::format("Here: {}", record["device"].get<std::string>()),
                      .x = {.title = "processor time of a frame", .unit = "ms", .low = 0}};
    double most = 0;
    for (const json& one : record["cases"]) {
        const double row = double(chart.y.rows.size()), ms = one["process_cpu_ms"];
        chart.y.rows.push_back(one["name"]);
        chart.bars.push_back(
            {.row = row,
             .from = 0,
             .to = ms,
             .paint = base::series_paint(row == 1   ? 0
                                         : row == 0 ? 1
                                                    : 2),
             .label = fmt::format("{:.1f} ms, {:.1f} frames per second", ms, one["fps"].get<double>())});
        most = std::max(most, ms);
    }
    chart.x.high = 1.9 * most; // room for the labels
    return chart;
}

} // namespace

std::span<const PaperRate> paper_rates()
{
    return rates;
}

json frame_rates(const std::vector<stage::Measurement>& measurements)
{
    json cases = json::array();
    const std::vector<double> first = stage::process_cpu_ms(measurements.front());
    for (const stage::Measurement& one : measurements) {
        const std::vector<double> process = stage::process_cpu_ms(one);
        const double wall = base::median(stage::wall_ms(one));
        const base::RatioInterval ratio = base::ratio_of_medians(first, process, interval_misses);
        cases.push_back({{"name", one.name},
                         {"process_cpu_ms", base::median(process)},
                         {"wall_ms", wall},
                         {"fps", 1000 / wall},
                         {"over_first", {{"ratio", ratio.ratio}, {"low", ratio.low}, {"high", ratio.high}}}});
    }
    return cases;
}

void draw_frame_rate(Workbench& bench)
{
    scene::Scene published = bench.scene("cheek", Equations::Published),
                 usual = bench.scene("cheek", Equations::Corrected);
    published.days = usual.days = {shown_day};
    stage::Renderer& renderer = bench.renderer();
    const stage::Stage paper = bench.showing(published), own = bench.showing(usual);
    optics::Shading ward = published.shading;
    ward.translucency = false;
    const stage::Rounds rounds{.counted = 0, .timed = bench.options().frames};
    bench.progress().expect(std::size_t(rounds.all()));
    const double load = base::load_average();
    const std::vector<stage::Measurement> measured =
        stage::measure(renderer.device, renderer.shaders,
                       {stage::shading_case("Lambert and Ward", paper, ward),
                        stage::shading_case("proposed, published", paper, published.shading),
                        stage::shading_case("our default", own, usual.shading)},
                       rounds, [&](int) {
                           bench.progress().step();
                           bench.progress().show("frames of frame-rate");
                       });
    json record{{"device", renderer.device.info().name},
                {"software_rasteriser", renderer.device.info().software},
                {"size", fmt::format("{}x{}", published.size[0], published.size[1])},
                {"frames", rounds.timed},
                {"load_before", load},
                {"cases", frame_rates(measured)},
                {"paper", json::array()}};
    for (const PaperRate& rate : rates)
        record["paper"].push_back({{"system", rate.system}, {"fps", rate.words}});
    bench.write_drawing("frame_rate", {940, 470}, "Frame rates", [&](base::Canvas& canvas) {
        base::draw_chart(canvas, {0, 0, 940, 270}, paper_chart());
        base::draw_chart(canvas, {0, 280, 940, 180}, our_chart(record));
    });
    bench.write_json("frame_rate", record);
    for (const json& one : record["cases"]) {
        const json& over = one["over_first"];
        bench.say(fmt::format("{}: {:.1f} ms of processor time, {:.1f} frames per second, {:.3f} ({:.3f} to "
                              "{:.3f}) of Lambert and Ward",
                              one["name"].get<std::string>(), one["process_cpu_ms"].get<double>(),
                              one["fps"].get<double>(), over["ratio"].get<double>(),
                              over["low"].get<double>(), over["high"].get<double>()));
    }
    bench.say(fmt::format("{}{}, {}, medians of {} frames of each case, drawn in turn; load before: {:.1f}. "
                          "The paper: proposed / Ward = {:.3f}",
                          record["device"].get<std::string>(),
                          renderer.device.info().software ? " (a software rasteriser)" : "",
                          record["size"].get<std::string>(), rounds.timed, load, rates[0].fps / rates[2].fps));
}

} // namespace figure_command
