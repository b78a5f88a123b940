#include "apps/report/report.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/report/cases.hpp"
#include "apps/report/comparison.hpp"
#include "apps/report/json.hpp"
#include "apps/report/page.hpp"
#include "apps/report/sweep.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/machine.hpp"
#include "base/number_option.hpp"
#include "base/progress.hpp"
#include "scene/command_line.hpp"
#include "scene/file.hpp"
#include "stage/kept_light.hpp"
#include "stage/renderer.hpp"

namespace report_command {
namespace {
using nlohmann::json;

const cv::Size sweep_size(800, 400); // of a sweep's chart picture, px

struct ReportOptions : scene::SceneOptions
{
    std::filesystem::path out = "out/report", against;
    std::optional<int> frames;
    std::vector<std::string> sweeps, cases;
};

/// Replaces paths by file names: a report can be published without revealing folders.
json without_folders(json scene)
{
    if (scene.is_string() && scene.get_ref<const std::string&>().find('/') != std::string::npos)
        return std::filesystem::path(scene.get<std::string>()).filename().string();
    if (scene.is_structured())
        for (json& value : scene)
            value = without_folders(value);
    return scene;
}

json device_json(const gpu::DeviceInfo& info)
{
    return {{"name", info.name},
            {"type", info.type},
            {"driver", info.driver},
            {"vulkan",
             fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(info.api_version),
                         VK_API_VERSION_MINOR(info.api_version), VK_API_VERSION_PATCH(info.api_version))},
            {"software_rasteriser", info.software},
            {"timestamps", info.timestamps},
            {"counts_invocations", info.statistics}};
}

const char* words_for(gpu::Alignment alignment)
{
    return alignment == gpu::Alignment::Calibrated ? "calibrated timestamps"
           : alignment == gpu::Alignment::Bounds   ? "submission and fence"
                                                   : "nothing: the device has no timestamps";
}

/// The alignment method of the last frame and the largest error of all frames.
json alignment_json(const std::vector<stage::Measurement>& measurements)
{
    gpu::Alignment alignment = gpu::Alignment::None;
    double error_ms = 0;
    for (const stage::Measurement& one : measurements)
        for (const stage::TimedFrame& frame : one.frames) {
            alignment = frame.result.alignment;
            error_ms = std::max(error_ms, frame.result.alignment_error_ms);
        }
    return {{"method", gpu::name_of(alignment)}, {"words", words_for(alignment)}, {"error_ms", error_ms}};
}

/// A callback for stage::measure() that reports every round to `progress`.
std::function<void(int)> rounds_of(base::Progress& progress, const std::string& what,
                                   const stage::Rounds& rounds)
{
    progress.expect(std::size_t(rounds.all()));
    return [&progress, what](int) {
        progress.step();
        progress.show(what);
    };
}

/// The device's name; marks software rasterisers.
std::string device_title(const gpu::DeviceInfo& info)
{
    return info.name + (info.software ? ", a software rasteriser" : "");
}

void print_head(const json& facts)
{
    const json &device = facts.at("device"), &machine = facts.at("machine"), &load = facts.at("load");
    fmt::print("{} ({}), {}{}\n", device.at("name").get<std::string>(), device.at("type").get<std::string>(),
               device.at("driver").get<std::string>(),
               device.at("software_rasteriser")
                   ? "\na software rasteriser: \"GPU\" below means this machine's processor"
                   : "");
    fmt::print("{} cores, load {:.1f} before and {:.1f} after; {}, {} triangles; GPU times aligned by {} "
               "(within {:.2g} ms)\n",
               machine.at("cores").dump(), load.at("before").get<double>(), load.at("after").get<double>(),
               facts.at("settings").at("size").get<std::string>(), facts.at("head").at("triangles").dump(),
               facts.at("alignment").at("words").get<std::string>(),
               facts.at("alignment").at("error_ms").get<double>());
    if (load.at("before") > machine.at("cores"))
        fmt::print("note: the machine was busy with other work at the start: times are upper bounds\n");
    fmt::print("\n");
}

json facts_of(const ReportOptions& options, const scene::Scene& scene, const gpu::Device& device,
              const stage::Rounds& rounds)
{
    return {{"program", base::program_json()},
            {"device", device_json(device.info())},
            {"machine", base::machine_json()},
            {"settings",
             {{"size", fmt::format("{}x{}", scene.size[0], scene.size[1])},
              {"samples_per_pixel", scene.samples},
              {"mode", options.mode == "published" ? "published" : "corrected"},
              {"validation", options.validation},
              {"frames", rounds.timed},
              {"warm_up_frames", rounds.warm_up},
              {"counted_frames", rounds.counted}}},
            {"scene", without_folders(scene::to_json(scene))}};
}

void sweep(const ReportOptions& options, const scene::Scene& scene, const gpu::Device& device,
           const graph::ShaderLibrary& library, const stage::Rounds& rounds, json facts)
{
    facts["load"] = {{"before", base::load_average()}};
    json record = json::array();
    base::Progress progress;
    for (const std::string& kind : options.sweeps) {
        const Sweep measured =
            measure_sweep(kind, scene, device, library, rounds, rounds_of(progress, kind, rounds));
        progress.clear();
        const base::Chart chart = sweep_chart(measured, device_title(device.info()));
        base::write_png(options.out / fmt::format("sweep_{}.png", kind),
                        base::chart_picture(chart, sweep_size));
        base::write_text(options.out / fmt::format("sweep_{}.svg", kind),
                         base::chart_svg(chart, sweep_size, base::SvgUse::StandAlone));
        record.push_back(to_json(measured));
        fmt::print("{}\n", to_text(measured));
    }
    facts["load"]["after"] = base::load_average();
    stage::fail_on_validation(device);
    json all{{"format", "cicatrix sweep"}, {"version", 1}};
    all.update(facts);
    all["sweeps"] = record;
    base::write_json(options.out / "sweep.json", all);
    fmt::print("{}: sweep.json and {} charts, PNG and SVG, in {}\n", device_title(device.info()),
               options.sweeps.size(), options.out.string());
}

/// How much a picture differs when light is kept on the skin. Returns a line of text.
std::string add_kept_light(json& facts, const gpu::Device& device, const graph::ShaderLibrary& library,
                           const stage::Stage& stage)
{
    gpu::Executor executor(device, library);
    const stage::KeptLightError error = stage::measure_kept_light(
        executor, stage,
        {.day = stage.scene().days.front(), .tile = stage.scene().size, .every_frame = false});
    facts["kept_light"] = {{"kept", error.kept},  {"pixels", error.pixels}, {"mean_de", error.mean},
                           {"p95_de", error.p95}, {"p999_de", error.p999},  {"max_de", error.max}};
    if (!error.kept)
        return "light is not kept on this skin: it is computed in every pixel";
    return fmt::format("light kept on the skin differs from light computed in every pixel by {:.2f} "
                       "CIEDE2000 (mean over the "
                       "head; p95 {:.2f}, p99.9 {:.2f}, worst pixel {:.1f})",
                       error.mean, error.p95, error.p999, error.max);
}

/// What many small wounds cost beside a large one, if both cases were measured. Returns a line of text.
std::string add_wound_ratio(json& facts, const std::vector<CaseSummary>& summaries)
{
    const auto one = std::ranges::find(summaries, wound_case_names().front(), &CaseSummary::name),
               many = std::ranges::find(summaries, wound_case_names().back(), &CaseSummary::name);
    if (one == summaries.end() || many == summaries.end())
        return "";
    const double ratio = many->process_cpu_ms.median / one->process_cpu_ms.median;
    facts["many_over_one_wound"] = ratio;
    return fmt::format(
        "64 wounds of 6 mm against one of 30 mm, turning camera: {:.2f} of its CPU ms ({:.1f} / {:.1f})\n",
        ratio, many->process_cpu_ms.median, one->process_cpu_ms.median);
}

void report(const ReportOptions& options)
{
    const scene::Scene scene = scene::chosen_scene(options);
    json before; // read before measuring, so that a wrong file is reported at once
    if (!options.against.empty())
        before = read_report(options.against);
    base::make_folder(options.out);
    const gpu::Device device(stage::device_options(options));
    const graph::ShaderLibrary library;
    const stage::Rounds rounds{.timed = options.frames.value_or(options.sweeps.empty() ? 60 : 15)};
    json facts = facts_of(options, scene, device, rounds);
    if (!options.sweeps.empty()) {
        sweep(options, scene, device, library, rounds, facts);
        return;
    }
    stage::Stage stage(device, stage::Stage::prepare(scene));
    std::vector<stage::MeasuredCase> cases = report_cases(stage, options.cases);
    for (stage::MeasuredCase& one : wound_cases(device, scene, options.cases))
        cases.push_back(std::move(one));
    graph::Graph first;
    cases.front().declare(first, 0);
    facts["head"] = {{"triangles", triangles_drawn(first)}};
    facts["load"] = {{"before", base::load_average()}};
    base::Progress progress;
    const std::vector<stage::Measurement> measurements =
        stage::measure(device, library, cases, rounds, rounds_of(progress, "frames of each case", rounds));
    progress.clear();
    facts["load"]["after"] = base::load_average();
    facts["alignment"] = alignment_json(measurements);
    stage::fail_on_validation(device);

    const std::string kept = add_kept_light(facts, device, library, stage);
    std::vector<CaseSummary> summaries;
    for (const stage::Measurement& measurement : measurements)
        summaries.push_back(summarise(measurement));
    const std::string wounds = add_wound_ratio(facts, summaries);
    const json record = report_json(facts, summaries, measurements);
    std::optional<Comparison> comparison;
    if (!options.against.empty())
        comparison = compare_reports(before, record, options.against);
    base::write_json(options.out / "report.json", record);
    base::write_json(options.out / "trace.json", trace_json(facts, measurements));
    base::write_text(options.out / "report.html", report_page(facts, summaries, measurements, comparison));
    print_head(facts);
    for (const CaseSummary& summary : summaries)
        fmt::print("{}\n", to_text(summary));
    if (comparison)
        fmt::print("{}\n", to_text(*comparison));
    fmt::print("{}\n{}", kept, wounds);
    fmt::print("report.html, report.json and trace.json (for ui.perfetto.dev or chrome://tracing) in {}\n",
               options.out.string());
}

std::vector<std::string> all_case_names()
{
    std::vector<std::string> names = case_names();
    names.insert(names.end(), wound_case_names().begin(), wound_case_names().end());
    return names;
}

} // namespace

void add(CLI::App& program)
{
    auto options = std::make_shared<ReportOptions>();
    CLI::App* command = program.add_subcommand(
        "report",
        "Measure the cost of each pass: table, page, JSON, trace; comparison with an earlier report; sweeps");
    scene::add_scene_options(*command, *options);
    command
        ->add_option(
            "--frames", options->frames,
            "Measured frames of each case (default 60) or of each step of a sweep (15), after a warm-up")
        ->transform(base::whole_number_from(5, 10000))
        ->type_name("N");
    command->add_option("--out", options->out, "Folder for report.html, report.json and trace.json")
        ->capture_default_str()
        ->type_name("DIR");
    auto* against =
        command
            ->add_option("--against", options->against,
                         "Compare with this earlier report.json: ratios, and which of them exceed the noise")
            ->type_name("REPORT.json");
    auto* sweep =
        command
            ->add_option(
                "--sweep", options->sweeps,
                "Instead of the cases, measure how the cost grows with: size, triangles, wounds, points "
                "(control points), lut (reflectance table); separate several by commas")
            ->delimiter(',')
            ->check(CLI::IsMember(sweep_names()))
            ->type_name("KIND")
            ->excludes(against);
    command
        ->add_option("--cases", options->cases,
                     fmt::format("Only these cases, separated by commas: {}; or, only when named, {}",
                                 fmt::join(case_names(), ", "), fmt::join(wound_case_names(), ", ")))
        ->delimiter(',')
        ->check(CLI::IsMember(all_case_names()))
        ->type_name("NAME")
        ->excludes(sweep);
    command->footer("Examples: cicatrix report --out before\n"
                    "          cicatrix report --out after --against before/report.json\n"
                    "          cicatrix report --sweep size,wounds --frames 20\n"
                    "          cicatrix report --cases camera,day --frames 100\n"
                    "Method: docs/report.md");
    command->callback([options] { report(*options); });
}

} // namespace report_command
