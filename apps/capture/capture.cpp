#include "apps/capture/capture.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <future>
#include <optional>

#include "apps/capture/gallery.hpp"
#include "base/file.hpp"
#include "base/number_option.hpp"
#include "base/text.hpp"
#include "scene/command_line.hpp"
#include "stage/capture.hpp"
#include "stage/labels.hpp"

namespace capture_command {
namespace {

struct CommandOptions : scene::SceneOptions
{
    stage::CaptureOptions capture;
    bool no_cost = false, labels = false, gallery = false;
};

const char* const gallery_days = "0,2,5,10,20,40,180"; // unless --days or a scene file says which

void run_gallery(CommandOptions options)
{
    if (options.days.empty() && options.scene.empty())
        options.days = gallery_days;
    const scene::Scene scene = scene::chosen_scene(options);
    base::make_folder(options.capture.out);
    stage::Renderer renderer(stage::device_options(options));
    stage::Stage stage(renderer.device, stage::Stage::prepare(scene));
    base::Progress progress;
    draw_gallery(renderer, stage, options.capture.out, progress);
    fmt::print("gallery.png and gallery.json in {}\n", options.capture.out.string());
}

void run_capture(CommandOptions& options)
{
    if (options.gallery)
        return run_gallery(options);
    const scene::Scene scene = scene::chosen_scene(options);
    options.capture.cost = !options.no_cost;
    if (!options.scene.empty())
        options.capture.title = std::filesystem::path(options.scene).stem().string();
    if (options.mode == "published")
        options.capture.mode = options.mode;
    stage::check_capture(options.capture, scene);
    base::make_folder(options.capture.out);
    if (options.capture.video.has_parent_path())
        base::make_folder(options.capture.video.parent_path());
    auto preparation = std::async(std::launch::async, [&scene] { return stage::Stage::prepare(scene); });
    stage::Renderer renderer(stage::device_options(options));
    const stage::Stage stage(renderer.device, preparation.get());
    for (const std::string& note : stage.loaded().notes)
        fmt::print(stderr, "note: {}\n", base::printable(note));

    std::optional<stage::LabelFiles> labels;
    if (options.labels) {
        labels.emplace(renderer, options.capture.out, options.capture.tile);
        options.capture.after_picture = [&](const stage::Stage& shown, const scene::Shot& shot,
                                            nlohmann::json& entry) { labels->add(shown, shot, entry); };
    }

    base::Progress progress;
    std::vector<std::string> lines;
    const nlohmann::json record = stage::capture(renderer, stage, options.capture, progress, lines);
    if (labels)
        labels->finish();
    progress.clear();
    fmt::print("{} pictures, healing.png and capture.json in {}\n", record["days"].size(),
               options.capture.out.string());
    for (const nlohmann::json& film : record.value("films", nlohmann::json::array()))
        fmt::print("{} frames in {}\n", film["frames"].size(), film["file"].get<std::string>());
    if (labels)
        fmt::print("labels: labels.json, coco.json and labels.png\n");
    for (const std::string& line : lines)
        fmt::print("{}\n", line);
}

} // namespace

void add(CLI::App& program)
{
    auto options = std::make_shared<CommandOptions>();
    CLI::App* command = program.add_subcommand(
        "capture", "Draw pictures of a healing wound, day by day, and measure what each costs");
    scene::add_scene_options(*command, *options);
    command
        ->add_option("--out", options->capture.out, "Folder for the pictures, healing.png and capture.json")
        ->capture_default_str()
        ->type_name("DIR");
    std::string views = "Views to show, separated by commas: the scene's own, or";
    for (const auto& [name, shows] : scene::standard_views())
        views += fmt::format(" {} ({}),", name, shows);
    views.pop_back();
    command->add_option("--views", options->capture.views, views)
        ->delimiter(',')
        ->allow_extra_args(false) // the next argument may be the scene
        ->type_name("NAMES");
    command
        ->add_option("--orbit", options->capture.orbit,
                     "N pictures from around the head instead of one per day; the day advances from the "
                     "first to the last of --days")
        ->transform(base::whole_number_from(1, 10000))
        ->type_name("N");
    command
        ->add_option("--orbit-degrees", options->capture.orbit_deg, "Angle that the camera of --orbit covers")
        ->type_name("DEGREES")
        ->check(base::number_from(-3600, 3600))
        ->capture_default_str();
    command
        ->add_option(
            "--video", options->capture.video,
            "Also write a film; the day advances evenly from the first to the last of --days, and with "
            "--orbit the camera moves around the head. Needs the program ffmpeg")
        ->type_name("FILE.mp4");
    command->add_option("--duration", options->capture.duration_s, "Duration of the film")
        ->type_name("SECONDS")
        ->check(base::number_from(0.01, 3600))
        ->capture_default_str();
    command->add_option("--fps", options->capture.fps, "Frames per second of the film")
        ->type_name("N")
        ->check(base::number_from(1, 240))
        ->capture_default_str();
    command->add_flag("--transparent", options->capture.transparent,
                      "Transparent background: PNG with straight alpha, EXR premultiplied");
    command->add_flag("--exr", options->capture.exr,
                      "Also write each picture as OpenEXR: linear light before exposure and encoding");
    command
        ->add_option("--tile", options->capture.tile,
                     "Longest side of a tile in pixels; larger pictures are drawn in tiles")
        ->capture_default_str()
        ->type_name("PX");
    command->add_flag(
        "--labels", options->labels,
        "Also write labels of every picture: classes, wounds, mask, depth and distance as images, areas "
        "in pixels and mm2, camera; labels.json, coco.json (docs/labels.md)");
    auto* gallery = command->add_flag(
        "--gallery", options->gallery,
        "Instead, one page of all kinds of default wound over the days: gallery.png; on days 0 to 180 "
        "unless --days or a scene file says which");
    for (const char* other :
         {"--views", "--orbit", "--video", "--transparent", "--exr", "--labels", "--wound", "--mask"})
        gallery->excludes(command->get_option(other));
    command->add_flag("--no-cost", options->no_cost, "Skip the cost measurement at the end");
    command->footer("Examples:\n"
                    "  cicatrix capture --days 0:30:3 --wound photo.jpg --mask mask.png --out healing\n"
                    "  cicatrix capture --days 0:30:10 --views front,left,close-up\n"
                    "  cicatrix capture --days 0,30 --video healing.mp4 --duration 10\n"
                    "  cicatrix capture --days 5 --orbit 36 --transparent --size 800x800\n"
                    "  cicatrix capture --days 0,9,18 --labels --no-cost\n"
                    "  cicatrix capture --gallery");
    command->callback([options] { run_capture(*options); });
}

} // namespace capture_command
