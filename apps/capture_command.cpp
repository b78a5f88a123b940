#include <fmt/format.h>
#include <future>

#include "apps/capture.hpp"
#include "apps/output.hpp"
#include "apps/scene_options.hpp"
#include "wound/input_error.hpp"

namespace app {
namespace {

struct CommandOptions : SceneOptions
{
    CaptureOptions capture;
    bool no_cost = false;
};

void check_tile(std::uint32_t tile)
{
    if (tile < 64 || tile > 16384 || tile % 2 != 0)
        throw cicatrix::InputError("--tile", fmt::format("is {}", tile),
                                   "give an even number of pixels from 64 to 16384");
}

void run_capture(CommandOptions& options)
{
    const Scene scene = chosen_scene(options);
    options.capture.cost = !options.no_cost;
    if (!options.scene.empty())
        options.capture.title = std::filesystem::path(options.scene).stem().string();
    if (options.mode == "published")
        options.capture.mode = options.mode;
    check_tile(options.capture.tile);
    make_folder(options.capture.out);
    auto props = std::async(std::launch::async, [&scene] { return Stage::prepare(scene); });
    Renderer renderer(device_options(options));
    const Stage stage(renderer.device, scene, props.get());
    for (const std::string& note : stage.notes())
        fmt::print(stderr, "note: {}\n", note);

    Progress progress;
    std::vector<std::string> lines;
    const nlohmann::json record = capture(renderer, stage, options.capture, progress, lines);
    progress.clear();
    fmt::print("{} pictures, healing.png and capture.json in {}\n", record["days"].size(),
               options.capture.out.string());
    for (const std::string& line : lines)
        fmt::print("{}\n", line);
}

} // namespace

void add_capture_command(CLI::App& program)
{
    auto options = std::make_shared<CommandOptions>();
    CLI::App* command =
        program.add_subcommand("capture", "Pictures of a wound healing, day by day, and what each cost");
    add_scene_options(*command, *options);
    command
        ->add_option("--out", options->capture.out, "Folder for the pictures, healing.png and capture.json")
        ->capture_default_str()
        ->type_name("DIR");
    std::string views = "Views to show, separated by commas: the scene's own, or";
    for (const auto& [name, shows] : standard_views())
        views += fmt::format(" {} ({}),", name, shows);
    views.pop_back();
    command->add_option("--views", options->capture.views, views)->delimiter(',')->type_name("NAMES");
    command
        ->add_option("--tile", options->capture.tile,
                     "Pictures with a longer side are drawn in tiles of at most so many pixels a side")
        ->capture_default_str()
        ->type_name("PX");
    command->add_flag("--no-cost", options->no_cost, "Leave out the cost measurement at the end");
    command->footer("Examples:\n"
                    "  cicatrix capture --days 0:30:3 --wound photo.jpg --mask mask.png --out healing\n"
                    "  cicatrix capture --days 0,10 --views front,left,close-up");
    command->callback([options] { run_capture(*options); });
}

} // namespace app
