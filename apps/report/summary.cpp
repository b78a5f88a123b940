#include "apps/report/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace report_command {
namespace {

using gpu::PassResult;
using graph::PassState;

constexpr std::array part_names{"declaring it (the day's wounds and warps)",
                                "checking and scheduling",
                                "recording the passes",
                                "recording the rest",
                                "passes on the GPU",
                                "between passes on the GPU",
                                "copying the picture out on the GPU",
                                "submitting and waking up",
                                "fetching the picture"};

/// Times in ms, in the order of part_names; their sum is the frame's wall clock.
std::array<double, part_names.size()> parts_of(const stage::TimedFrame& frame)
{
    const gpu::FrameResult& result = frame.result;
    double sum = 0, recorded = 0;
    for (const PassResult& pass : result.passes) {
        sum += pass.gpu_ms.value_or(0);
        recorded += pass.cpu_ms;
    }
    const double between = result.gpu_ms.value_or(0) - sum, copy = result.copy ? result.copy->ms : 0;
    const gpu::HostTimes& host = result.host;
    return {frame.declare_ms,
            host.schedule_ms,
            recorded,
            host.record_ms - recorded,
            sum,
            between,
            copy,
            host.submit_ms + host.wait_ms - sum - between - copy,
            host.readback_ms};
}

PassSummary& find_or_add(std::vector<PassSummary>& passes, const std::string& name)
{
    const auto found = std::ranges::find(passes, name, &PassSummary::name);
    return found != passes.end() ? *found : passes.emplace_back(PassSummary{.name = name});
}

/// Fills the summary of the pass `summary.name` from all frames of a measurement.
void fill(PassSummary& summary, const stage::Measurement& measurement)
{
    std::vector<double> gpu, cpu, bytes, refreshed, vertex, fragment, compute;
    for (const stage::TimedFrame& frame : measurement.frames)
        for (const PassResult& pass : frame.result.passes) {
            if (pass.name != summary.name)
                continue;
            summary.reason = pass.reason;
            summary.ran += pass.state == PassState::Run;
            summary.skipped += pass.state == PassState::Skipped;
            summary.culled += pass.state == PassState::Culled;
            if (pass.state != PassState::Run)
                continue;
            if (pass.gpu_ms)
                gpu.push_back(*pass.gpu_ms);
            cpu.push_back(pass.cpu_ms);
            bytes.push_back(double(pass.work.bytes_written));
            refreshed.push_back(pass.work.refreshed);
            summary.share +=
                (pass.gpu_ms.value_or(0) + pass.cpu_ms) / frame.wall_ms() / double(measurement.frames.size());
        }
    for (const stage::TimedFrame& frame : measurement.counted)
        for (const PassResult& pass : frame.result.passes)
            if (pass.name == summary.name && pass.invocations) {
                vertex.push_back(double(pass.invocations->vertex));
                fragment.push_back(double(pass.invocations->fragment));
                compute.push_back(double(pass.invocations->compute));
            }
    summary.gpu_ms = base::spread_of(gpu);
    summary.cpu_ms = base::spread_of(cpu);
    if (!bytes.empty()) {
        summary.bytes_written = base::quantile(bytes, 0.5);
        summary.refreshed = base::quantile(refreshed, 0.5);
    }
    const auto middle = [](const std::vector<double>& counts) {
        return std::uint64_t(std::llround(base::quantile(counts, 0.5)));
    };
    if (!vertex.empty())
        summary.invocations = gpu::Invocations{middle(vertex), middle(fragment), middle(compute)};
}

std::string short_count(std::uint64_t count)
{
    return count >= 10'000'000 ? fmt::format("{:.0f}M", double(count) / 1e6)
           : count >= 10'000   ? fmt::format("{:.0f}k", double(count) / 1e3)
                               : fmt::format("{}", count);
}

/// "45k vertex, 12M fragment": the shader stages with invocations.
std::string invocations_text(const std::optional<gpu::Invocations>& counts)
{
    if (!counts)
        return "-";
    std::string text;
    for (const auto& [count, kind] :
         {std::pair(counts->vertex, "vertex"), {counts->fragment, "fragment"}, {counts->compute, "compute"}})
        if (count > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", short_count(count), kind);
    return text;
}

std::string spread_text(const std::optional<base::Spread>& spread)
{
    return spread ? fmt::format("{:8.3f} {:8.3f} {:8.3f}", spread->median, spread->p5, spread->p95)
                  : fmt::format("{:>8} {:>8} {:>8}", "-", "-", "-");
}

} // namespace

std::string rate_text(double wall_ms)
{
    constexpr double budget_60_ms = 1000. / 60, budget_30_ms = 1000. / 30;
    return fmt::format("{:.1f} frames/s, {}", 1e3 / wall_ms,
                       wall_ms <= budget_60_ms   ? "within 16.7 ms"
                       : wall_ms <= budget_30_ms ? "within 33.3 ms"
                                                 : "above 33.3 ms");
}

CaseSummary summarise(const stage::Measurement& measurement)
{
    CaseSummary summary{.name = measurement.name, .what = measurement.what};
    std::vector<double> sums, envelopes;
    std::array<std::vector<double>, part_names.size()> parts;
    std::array<double, part_names.size()> shares{};
    for (const stage::TimedFrame& frame : measurement.frames) {
        double sum = 0;
        for (const PassResult& pass : frame.result.passes) {
            find_or_add(summary.passes, pass.name);
            sum += pass.gpu_ms.value_or(0);
        }
        if (frame.result.gpu_ms) {
            sums.push_back(sum);
            envelopes.push_back(*frame.result.gpu_ms);
        }
        const auto times = parts_of(frame);
        for (std::size_t i = 0; i < times.size(); ++i) {
            parts[i].push_back(times[i]);
            shares[i] += times[i] / frame.wall_ms() / double(measurement.frames.size());
        }
    }
    for (PassSummary& pass : summary.passes) {
        fill(pass, measurement);
        summary.coverage += pass.share;
    }
    std::ranges::stable_sort(summary.passes, std::ranges::greater{}, &PassSummary::share);
    const std::vector<double> walls = stage::wall_ms(measurement);
    summary.wall_ms = base::spread_of(walls).value();
    summary.process_cpu_ms = base::spread_of(stage::process_cpu_ms(measurement)).value();
    summary.work = stage::mean_work(measurement);
    summary.sum_ms = base::spread_of(sums);
    summary.envelope_ms = base::spread_of(envelopes);
    for (std::size_t i = 0; i < part_names.size(); ++i)
        summary.parts.push_back({part_names[i], shares[i], base::spread_of(parts[i]).value()});
    const auto nearest = std::ranges::min_element(
        walls, {}, [&](double wall) { return std::abs(wall - summary.wall_ms.median); });
    summary.median_frame = std::size_t(nearest - walls.begin());
    return summary;
}

std::string to_text(const CaseSummary& summary)
{
    std::string text = fmt::format("{}: {}\n", summary.name, summary.what);
    text += fmt::format("  {:<20} {:>8} {:>8} {:>8}  {:>8} {:>8} {:>8}  {:>6}  {:>13}  {:>9}  {:>9}  {}\n",
                        "pass", "GPU ms", "p5", "p95", "CPU ms", "p5", "p95", "share", "ran/skip/cull",
                        "refreshed", "kB out", "invocations");
    for (const PassSummary& pass : summary.passes)
        text += fmt::format("  {:<20} {}  {}  {:5.1f}%  {:>13}  {:>9}  {:>9}  {}\n", pass.name,
                            spread_text(pass.gpu_ms), spread_text(pass.cpu_ms), 100 * pass.share,
                            fmt::format("{}/{}/{}", pass.ran, pass.skipped, pass.culled),
                            pass.ran > 0 ? fmt::format("{:.1f} %", 100 * pass.refreshed) : "-",
                            pass.ran > 0 ? fmt::format("{:.0f}", pass.bytes_written / 1e3) : "-",
                            invocations_text(pass.invocations));
    text += fmt::format(
        "  frame {:.2f} ms ({:.2f} to {:.2f}), {}; {:.2f} CPU ms ({:.2f} to {:.2f}) of all threads",
        summary.wall_ms.median, summary.wall_ms.p5, summary.wall_ms.p95, rate_text(summary.wall_ms.median),
        summary.process_cpu_ms.median, summary.process_cpu_ms.p5, summary.process_cpu_ms.p95);
    if (summary.sum_ms)
        text += fmt::format("; passes {:.2f} ms in sum, {:.2f} from the first start to the last end",
                            summary.sum_ms->median, summary.envelope_ms->median);
    text += fmt::format("; the passes explain {:.1f} %, the rest is", 100 * summary.coverage);
    std::vector<FramePart> rest;
    for (std::size_t i = 0; i < summary.parts.size(); ++i)
        if (part_names[i] != std::string_view("passes on the GPU") &&
            part_names[i] != std::string_view("recording the passes"))
            rest.push_back(summary.parts[i]);
    std::ranges::sort(rest, std::ranges::greater{}, &FramePart::share);
    for (std::size_t i = 0; i < 3; ++i)
        text += fmt::format("{} {} {:.1f} %", i == 0 ? "" : ",", rest[i].name, 100 * rest[i].share);
    const stage::FrameWork& work = summary.work;
    text += fmt::format(
        "\n  counted per frame: {:.1f} passes, {:.0f} texels refreshed, {:.0f} kB written, {:.1f} maps "
        "sampled",
        work.passes, work.texels, work.bytes_written / 1e3, work.maps_sampled);
    if (work.invocations)
        text += fmt::format("; invocations: {:.0f} vertex, {:.0f} fragment, {:.0f} compute",
                            work.invocations->vertex, work.invocations->fragment, work.invocations->compute);
    return text + "\n";
}

} // namespace report_command
