#include "apps/report/page.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/report/charts.hpp"
#include "base/html.hpp"
#include "base/palette.hpp"

namespace report_command {
namespace {
using nlohmann::json;

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Cicatrix: what each pass costs</title>
<style>
)";
constexpr const char* style =
    R"(body { background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, sans-serif; max-width: 1080px;
  margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; } h2 { margin-top: 2em; border-bottom: 1px solid var(--grid); }
h3 { font-size: 1em; margin-bottom: 0; }
svg { width: 100%; display: block; }
table { border-collapse: collapse; font-size: 14px; font-variant-numeric: tabular-nums; margin: .5em 0; }
th, td { text-align: right; padding: .15em .5em; white-space: nowrap; border-bottom: 1px solid var(--grid); }
th { color: var(--faint); font-weight: normal; } td:first-child, th:first-child, .words td { text-align: left; }
.scroll { overflow-x: auto; } .note { background: var(--note); padding: .6em 1em; border-radius: 4px; }
.slower { color: var(--slower); } .faster { color: var(--faster); } .faint { color: var(--faint); }
pre { overflow-x: auto; font-size: 12px; }
</style></head><body>
)";

/// A string without quotes, a float with 3 digits, null as "unknown", other values as JSON.
std::string plain(const json& value)
{
    return value.is_string()         ? value.get<std::string>()
           : value.is_number_float() ? fmt::format("{:.3g}", value.get<double>())
           : value.is_null()         ? "unknown"
                                     : value.dump();
}

std::string facts_table(const json& facts)
{
    const json &device = facts.at("device"), &machine = facts.at("machine"), &program = facts.at("program"),
               &settings = facts.at("settings"), &load = facts.at("load"), &alignment = facts.at("alignment");
    const bool software = device.at("software_rasteriser");
    std::string table = "<table class=\"words\">";
    const auto row = [&](const char* name, const std::string& value) {
        table += fmt::format("<tr><td class=\"faint\">{}</td><td>{}</td></tr>\n", name, base::escaped(value));
    };
    row("Device", fmt::format("{} ({}{})", plain(device["name"]), plain(device["type"]),
                              software ? ", software rasteriser" : ""));
    row("Driver", fmt::format("{}, Vulkan {}", plain(device["driver"]), plain(device["vulkan"])));
    row("Machine",
        fmt::format("{}, {} cores, {} GiB of memory, {} free", plain(machine["cpu"]), plain(machine["cores"]),
                    plain(machine["memory_gib"]), plain(machine["memory_free_gib"])));
    row("System", fmt::format("{}, {}", plain(machine["os"]), plain(machine["kernel"])));
    row("Load", fmt::format("{:.2f} before, {:.2f} after, of {} cores", load["before"].get<double>(),
                            load["after"].get<double>(), plain(machine["cores"])));
    row("Program", fmt::format("cicatrix {}, {}{}, {}", plain(program["version"]), plain(program["build"]),
                               program["sanitizers"] ? " with sanitizers" : "", plain(program["compiler"])));
    row("Picture",
        fmt::format("{}, {} samples per pixel, {} mode{}; {} triangles", plain(settings["size"]),
                    plain(settings["samples_per_pixel"]), plain(settings["mode"]),
                    settings["validation"] ? ", validation on" : "", plain(facts["head"]["triangles"])));
    row("Frames",
        fmt::format("{} of each case, interleaved, after {} of warm-up and {} for counting invocations",
                    plain(settings["frames"]), plain(settings["warm_up_frames"]),
                    plain(settings["counted_frames"])));
    row("Alignment", fmt::format("CPU and GPU clocks by {}, within {:.2g} ms", plain(alignment["words"]),
                                 alignment["error_ms"].get<double>()));
    return table + "</table>\n";
}

std::string spread_cells(const std::optional<base::Spread>& spread)
{
    return spread ? fmt::format("<td>{:.3f}</td><td class=\"faint\">{:.3f} .. {:.3f}</td>", spread->median,
                                spread->p5, spread->p95)
                  : "<td>-</td><td>-</td>";
}

std::string pass_table(const CaseSummary& summary)
{
    std::string table =
        "<div class=\"scroll\"><table><tr><th>pass<th>GPU ms<th>p5 .. p95<th>CPU ms<th>p5 .. p95<th>share"
        "<th>ran<th>skipped<th>culled<th>refreshed<th>kB written<th>vertex<th>fragment<th>compute</tr>\n";
    for (const PassSummary& pass : summary.passes) {
        table += fmt::format("<tr><td title=\"{}\">{}</td>{}{}<td>{:.1f} %</td><td>{}</td><td>{}</td>"
                             "<td>{}</td><td>{:.1f} %</td><td>{:.0f}</td>",
                             base::escaped(pass.reason), base::escaped(pass.name), spread_cells(pass.gpu_ms),
                             spread_cells(pass.cpu_ms), 100 * pass.share, pass.ran, pass.skipped, pass.culled,
                             100 * pass.refreshed, pass.bytes_written / 1e3);
        table += pass.invocations
                     ? fmt::format("<td>{}</td><td>{}</td><td>{}</td></tr>\n", pass.invocations->vertex,
                                   pass.invocations->fragment, pass.invocations->compute)
                     : "<td>-</td><td>-</td><td>-</td></tr>\n";
    }
    table += "</table></div>\n<table class=\"words\"><tr><th>of the frame's wall clock<th>share<th>ms</tr>\n";
    for (const FramePart& part : summary.parts)
        table +=
            fmt::format("<tr><td>{}</td><td>{:.1f} %</td><td>{:.3f} <span class=\"faint\">{:.3f} .. "
                        "{:.3f}</span></td></tr>\n",
                        base::escaped(part.name), 100 * part.share, part.ms.median, part.ms.p5, part.ms.p95);
    return table + "</table>\n";
}

/// What no clock blurs, a row for each case.
std::string work_table(const std::vector<CaseSummary>& summaries)
{
    std::string table =
        "<h2>Counted work of a frame</h2>\n<div class=\"scroll\"><table><tr><th>case<th>passes run"
        "<th>texels refreshed<th>kB written<th>maps sampled<th>vertex<th>fragment<th>compute</tr>\n";
    for (const CaseSummary& summary : summaries) {
        const stage::FrameWork& work = summary.work;
        table += fmt::format("<tr><td>{}</td><td>{:.1f}</td><td>{:.0f}</td><td>{:.0f}</td><td>{:.1f}</td>",
                             base::escaped(summary.name), work.passes, work.texels, work.bytes_written / 1e3,
                             work.maps_sampled);
        table += work.invocations ? fmt::format("<td>{:.0f}</td><td>{:.0f}</td><td>{:.0f}</td></tr>\n",
                                                work.invocations->vertex, work.invocations->fragment,
                                                work.invocations->compute)
                                  : "<td>-</td><td>-</td><td>-</td></tr>\n";
    }
    return table + "</table></div>\n";
}

std::string case_section(const CaseSummary& summary, const stage::Measurement& measurement,
                         const PassColors& colors)
{
    std::string text =
        fmt::format("<h2>{}</h2><p>{}. Frame {:.2f} ms ({:.2f} to {:.2f}), {}; {:.2f} CPU ms "
                    "({:.2f} to {:.2f}) of all threads.",
                    base::escaped(summary.name), base::escaped(summary.what), summary.wall_ms.median,
                    summary.wall_ms.p5, summary.wall_ms.p95, rate_text(summary.wall_ms.median),
                    summary.process_cpu_ms.median, summary.process_cpu_ms.p5, summary.process_cpu_ms.p95);
    if (summary.sum_ms)
        text +=
            fmt::format(" On the GPU the passes take {:.2f} ms in sum, {:.2f} ms from the start of the first "
                        "to the end of the last.",
                        summary.sum_ms->median, summary.envelope_ms->median);
    text += fmt::format(" The passes explain {:.1f} % of the frame.</p>\n", 100 * summary.coverage);
    return text + pass_table(summary) + "<h3>Every frame</h3>\n" +
           distributions(summary, measurement, colors) + "<h3>The median frame</h3>\n" +
           timeline(measurement.frames[summary.median_frame], colors);
}

std::string comparison_section(const Comparison& comparison)
{
    std::string text =
        fmt::format("<h2>Against {}</h2>\n",
                    base::escaped(std::filesystem::path(comparison.against).filename().string()));
    for (const std::string& warning : comparison.warnings)
        text += fmt::format("<p class=\"note\">{}</p>\n", base::escaped(warning));
    text += ratios(comparison);
    text +=
        "<div class=\"scroll\"><table class=\"words\"><tr><th>case<th>what<th>before ms<th>now ms<th>ratio"
        "<th>interval<th>drift<th></tr>\n";
    for (const ComparedTime& time : comparison.times) {
        const char* verdict = !time.exceeds_noise ? "faint" : time.ratio.ratio > 1 ? "slower" : "faster";
        text +=
            fmt::format("<tr><td>{}</td><td>{}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f} "
                        ".. {:.3f}</td><td>{:.3f}</td><td class=\"{}\">{}</td></tr>\n",
                        base::escaped(time.where), base::escaped(time.what), time.before_ms, time.after_ms,
                        time.ratio.ratio, time.ratio.low, time.ratio.high, time.drift, verdict,
                        time.exceeds_noise ? verdict : "within the noise");
    }
    return text + "</table></div><p class=\"faint\">Interval: moving-block bootstrap of the ratio of "
                  "medians, 5 % for all "
                  "comparisons together. A difference exceeds the noise when its interval also excludes "
                  "the drift: "
                  "the largest ratio between the halves of either run.</p>\n";
}

} // namespace

std::string report_page(const json& facts, const std::vector<CaseSummary>& summaries,
                        const std::vector<stage::Measurement>& measurements,
                        const std::optional<Comparison>& comparison)
{
    const PassColors colors(summaries);
    std::string page = head + base::css_variables() + style + "<h1>Cicatrix: what each pass costs</h1>\n";
    if (facts.at("device").at("software_rasteriser"))
        page += "<p class=\"note\">This device is a software rasteriser: \"GPU\" on this page means the "
                "machine's own processor.</p>\n";
    if (facts.at("load").at("before") > facts.at("machine").at("cores"))
        page += "<p class=\"note\">The machine was busy with other work at the start: times are upper "
                "bounds.</p>\n";
    page += facts_table(facts);
    page += "<h2>A frame of each case</h2>\n" + stacked_bars(summaries, colors);
    page += work_table(summaries);
    if (comparison)
        page += comparison_section(*comparison);
    for (std::size_t i = 0; i < summaries.size(); ++i)
        page += case_section(summaries[i], measurements[i], colors);
    return page +
           fmt::format("<h2>The scene</h2><details><summary>as JSON</summary><pre>{}</pre></details>\n"
                       "<p class=\"faint\">Shares are GPU and recording time / wall clock from declaring a "
                       "frame to its end. Method: docs/report.md of Cicatrix.</p>\n</body></html>\n",
                       base::escaped(facts.at("scene").dump(2, ' ', false, json::error_handler_t::replace)));
}

} // namespace report_command
