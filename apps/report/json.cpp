#include "apps/report/json.hpp"

namespace report_command {
namespace {
using gpu::PassResult;
using graph::PassState;
using nlohmann::json;

json pass_json(const PassSummary& pass)
{
    json invocations = nullptr;
    if (pass.invocations)
        invocations = {{"vertex", pass.invocations->vertex},
                       {"fragment", pass.invocations->fragment},
                       {"compute", pass.invocations->compute}};
    return {{"name", pass.name},
            {"ran", pass.ran},
            {"skipped", pass.skipped},
            {"culled", pass.culled},
            {"reason", pass.reason},
            {"gpu_ms", to_json(pass.gpu_ms)},
            {"cpu_ms", to_json(pass.cpu_ms)},
            {"share", pass.share},
            {"refreshed", pass.refreshed},
            {"bytes_written", pass.bytes_written},
            {"invocations", invocations}};
}

/// The times of every frame, in order; null where a pass did not run.
json samples_json(const CaseSummary& summary, const stage::Measurement& measurement)
{
    json gpu = json::object(), cpu = json::object();
    for (const PassSummary& pass : summary.passes)
        gpu[pass.name] = cpu[pass.name] = json::array();
    for (const stage::TimedFrame& frame : measurement.frames)
        for (const PassSummary& summed : summary.passes) {
            json gpu_ms = nullptr, cpu_ms = nullptr;
            for (const PassResult& pass : frame.result.passes)
                if (pass.name == summed.name && pass.state == PassState::Run) {
                    cpu_ms = pass.cpu_ms;
                    if (pass.gpu_ms)
                        gpu_ms = *pass.gpu_ms;
                }
            gpu[summed.name].push_back(gpu_ms);
            cpu[summed.name].push_back(cpu_ms);
        }
    return {{"wall_ms", stage::wall_ms(measurement)},
            {"process_cpu_ms", stage::process_cpu_ms(measurement)},
            {"gpu_ms", gpu},
            {"cpu_ms", cpu}};
}

// ---- The trace

constexpr int cpu_track = 1, gpu_track = 2;

json name_event(const char* what, int process, int track, const std::string& name)
{
    return {{"ph", "M"}, {"name", what}, {"pid", process}, {"tid", track}, {"args", {{"name", name}}}};
}

/// Appends the events of one case (complete events, phase X).
class Track
{
  public:
    Track(json& to, int process) : events_(to), process_(process) {}

    void add(int track, const std::string& name, double begin_ms, double ms, json args = json::object())
    {
        events_.push_back({{"ph", "X"},
                           {"name", name},
                           {"cat", track == gpu_track ? "gpu" : "cpu"},
                           {"pid", process_},
                           {"tid", track},
                           {"ts", 1e3 * begin_ms},
                           {"dur", 1e3 * ms},
                           {"args", std::move(args)}});
    }

    void add(const stage::TimedFrame& frame, std::size_t number)
    {
        const gpu::FrameResult& result = frame.result;
        json skipped = json::array(), culled = json::array();
        for (const PassResult& pass : result.passes) {
            if (pass.state == PassState::Skipped)
                skipped.push_back(pass.name);
            if (pass.state == PassState::Culled)
                culled.push_back(pass.name);
        }
        add(cpu_track, "frame", frame.start_ms, frame.wall_ms(),
            {{"number", number},
             {"skipped", skipped},
             {"culled", culled},
             {"alignment_error_us", 1e3 * result.alignment_error_ms}});
        add(cpu_track, "declare", frame.start_ms, frame.declare_ms);
        const double zero = frame.start_ms + frame.declare_ms;
        double at = zero;
        for (const auto& [name, ms] : {std::pair("schedule", result.host.schedule_ms),
                                       {"record", result.host.record_ms},
                                       {"submit", result.host.submit_ms},
                                       {"wait", result.host.wait_ms},
                                       {"fetch", result.host.readback_ms}})
        {
            add(cpu_track, name, at, ms);
            at += ms;
        }
        for (const PassResult& pass : result.passes) {
            if (pass.state != PassState::Run)
                continue;
            add(cpu_track, pass.name, zero + pass.cpu_begin_ms, pass.cpu_ms);
            if (pass.gpu_ms)
                add(gpu_track, pass.name, zero + pass.gpu_begin_ms.value_or(0), *pass.gpu_ms,
                    {{"reason", pass.reason}, {"bytes_written", pass.work.bytes_written}});
        }
        if (result.copy)
            add(gpu_track, "copy out", zero + result.copy->begin_ms, result.copy->ms);
    }

  private:
    json& events_;
    int process_;
};

} // namespace

json to_json(const base::Spread& spread)
{
    return {{"median", spread.median}, {"p5", spread.p5}, {"p95", spread.p95}};
}

json report_json(const json& facts, const std::vector<CaseSummary>& summaries,
                 const std::vector<stage::Measurement>& measurements)
{
    json report{{"format", "cicatrix report"}, {"version", 1}};
    report.update(facts);
    report["cases"] = json::array();
    for (std::size_t i = 0; i < summaries.size(); ++i) {
        const CaseSummary& summary = summaries[i];
        json passes = json::array(), parts = json::array();
        for (const PassSummary& pass : summary.passes)
            passes.push_back(pass_json(pass));
        for (const FramePart& part : summary.parts)
            parts.push_back({{"name", part.name}, {"share", part.share}, {"ms", to_json(part.ms)}});
        report["cases"].push_back({{"name", summary.name},
                                   {"what", summary.what},
                                   {"wall_ms", to_json(summary.wall_ms)},
                                   {"process_cpu_ms", to_json(summary.process_cpu_ms)},
                                   {"frames_per_second", 1e3 / summary.wall_ms.median},
                                   {"sum_ms", to_json(summary.sum_ms)},
                                   {"envelope_ms", to_json(summary.envelope_ms)},
                                   {"coverage", summary.coverage},
                                   {"work", stage::to_json(summary.work)},
                                   {"passes", passes},
                                   {"parts", parts},
                                   {"samples", samples_json(summary, measurements[i])}});
    }
    return report;
}

json trace_json(const json& facts, const std::vector<stage::Measurement>& measurements)
{
    json events = json::array();
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        const int process = int(i) + 1;
        events.push_back(name_event("process_name", process, 0, measurements[i].name));
        events.push_back(name_event("thread_name", process, cpu_track, "CPU"));
        events.push_back(
            name_event("thread_name", process, gpu_track,
                       facts.at("device").at("software_rasteriser") ? "GPU (software rasteriser)" : "GPU"));
        Track track(events, process);
        for (std::size_t n = 0; n < measurements[i].frames.size(); ++n)
            track.add(measurements[i].frames[n], n);
    }
    return {{"traceEvents", events}, {"displayTimeUnit", "ms"}, {"otherData", facts}};
}

} // namespace report_command
