#include "apps/reference/reference.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

#include "base/file.hpp"
#include "base/number_option.hpp"
#include "base/text.hpp"
#include "reference/command_line.hpp"
#include "reference/output.hpp"
#include "scene/command_line.hpp"
#include "scene/shots.hpp"

namespace reference_command {
namespace {

struct CommandOptions : scene::SceneOptions
{
    std::filesystem::path out = "reference";
    std::optional<double> day;
    std::string view;
    reference::Levels levels;
    reference::Until until;
    reference::TruthOptions tracing;
    std::uint64_t seed = 1;
};

std::string summary(const reference::Truth& truth, const std::filesystem::path& out)
{
    return fmt::format("{} samples per pixel{}, {:.0f} CPU seconds: reference.exr, .png and .json in {}",
                       truth.picture.samples(),
                       std::isfinite(truth.noise_de) ? fmt::format(", noise {:.2f} dE", truth.noise_de) : "",
                       truth.cpu_seconds, out.string());
}

void run(const CommandOptions& options)
{
    const scene::Scene scene = scene::chosen_scene(options);
    if (!options.view.empty())
        scene::view_names(scene, {options.view});
    base::make_folder(options.out);
    base::Progress progress;
    progress.show("loading");
    const scene::LoadedScene loaded = scene::load(scene);
    const reference::Request request{
        .camera = options.view.empty() ? loaded.camera()
                                       : scene::chosen_views(loaded, {options.view}).front().camera,
        .size = scene.size,
        .day = options.day.value_or(scene.days.front()),
        .levels = options.levels,
        .seed = options.seed};
    std::vector<std::string> notes = loaded.notes;
    const reference::Truth truth =
        reference::find_truth(loaded, request, options.until, progress, notes, options.tracing);
    progress.clear();
    for (const std::string& note : notes)
        fmt::print(stderr, "note: {}\n", base::printable(note));
    if (truth.picture.samples() == 0)
        throw base::Interrupted();
    reference::write_truth(options.out, loaded, request, truth);
    fmt::print("{}\n", summary(truth, options.out));
    if (truth.interrupted)
        throw base::Interrupted();
}

void add_quality_options(CLI::App& command, CommandOptions& options)
{
    reference::add_until_options(command, options.until);
    command.add_option("--random-seed", options.seed, "Another seed is another picture of the same truth")
        ->transform(base::whole_number_from(0, 4294967295))
        ->capture_default_str();
    command
        .add_option("--threads", options.tracing.threads,
                    "Of the tracing; 0: one per core. The picture is the same")
        ->transform(base::whole_number_from(0, 1024))
        ->capture_default_str();
    command.add_flag_callback(
        "--no-cache", [&options] { options.tracing.use_cache = false; },
        "Neither go on from what an earlier run kept, nor keep anything");
}

} // namespace

void add(CLI::App& app)
{
    auto options = std::make_shared<CommandOptions>();
    CLI::App* command = app.add_subcommand(
        "reference", "The scene path traced on the CPU: the truth that pictures are measured against");
    scene::add_scene_choice(*command, *options);
    command->add_option("--out", options->out, "Folder for reference.exr, reference.png and reference.json")
        ->capture_default_str()
        ->type_name("DIR");
    command->add_option("--day", options->day, "Day to show; without one: the first of the scene's days")
        ->check(base::number_from(0, 3650))
        ->type_name("DAY");
    command->add_option("--view", options->view, "One of the scene's views or of those that capture knows")
        ->type_name("NAME");
    add_quality_options(*command, *options);
    reference::add_level_options(*command, options->levels);
    command->footer(
        "A picture is kept in the cache folder, and a later run goes on from there; so does one after "
        "Ctrl-C.\nExamples:\n"
        "  cicatrix reference scene.json --noise 0.3 --out truth\n"
        "  cicatrix reference scene.json --day 12 --view close-up --seconds 600\n"
        "  cicatrix reference scene.json --no-subsurface --bounces 0 --no-ambient");
    command->callback([options] { run(*options); });
}

} // namespace reference_command
