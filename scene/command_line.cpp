#include "scene/command_line.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.hpp"
#include "scene/file.hpp"
#include "scene/scene.hpp"

namespace scene {

wound::SegmentationHints HintOptions::hints(const std::string& mask) const
{
    if (!mask.empty() && !(seed.empty() && rect.empty()))
        throw base::InputError("--seed, --rect", "are given together with a mask",
                               "give either a mask or hints");
    wound::SegmentationHints hints;
    if (!seed.empty())
        hints.seed = cv::Point(seed[0], seed[1]);
    if (!rect.empty())
        hints.rect = cv::Rect(rect[0], rect[1], rect[2], rect[3]);
    return hints;
}

void add_hint_options(CLI::App& command, HintOptions& options)
{
    command
        .add_option("--seed", options.seed,
                    "Without a mask: a pixel of the photograph inside the only wound to use")
        ->delimiter(',')
        ->expected(2)
        ->type_name("X,Y");
    command
        .add_option("--rect", options.rect,
                    "Without a mask: a rectangle of the photograph around the wounds to use")
        ->delimiter(',')
        ->expected(4)
        ->type_name("X,Y,W,H");
}

void add_scene_choice(CLI::App& command, SceneOptions& options)
{
    command
        .add_option("scene", options.scene,
                    "Scene file (docs/scene.md); without one: the default head with a wound on the cheek")
        ->type_name("SCENE.json");
    command.add_option("--head", options.head, "Head to use instead of the scene's")->type_name("FILE.glb");
    command.add_option("--wound", options.wound, "Photograph for the first wound")->type_name("PHOTO");
    command
        .add_option("--mask", options.mask,
                    "Mask of that photograph, white in the wound; without a mask the photograph is segmented")
        ->type_name("PICTURE");
    add_hint_options(command, options.hints);
    command.add_option("--size", options.size, "Size of the pictures, for example 1280x720")
        ->type_name("WxH");
    command.add_option("--mode", options.mode, "The paper's equations: published (as printed) or corrected")
        ->check(CLI::IsMember({"published", "corrected"}));
}

void add_scene_options(CLI::App& command, SceneOptions& options)
{
    add_scene_choice(command, options);
    command.add_option("--days", options.days, "Days to show: first:last:step, or a list such as 0,5,12")
        ->type_name("DAYS");
    command.add_flag("--msaa", options.msaa, "Four samples per pixel");
    command
        .add_option("--device", options.device,
                    "Vulkan device by index or part of its name; also CICATRIX_DEVICE")
        ->type_name("NAME|INDEX");
    command.add_flag("--validation", options.validation,
                     "Run under the Vulkan validation layers; any message is a failure");
}

namespace {

/// Applies --wound, --mask, --seed and --rect to the first wound.
void override_wound(const SceneOptions& options, Scene& scene)
{
    const wound::SegmentationHints hints = options.hints.hints(options.mask);
    if (options.wound.empty() && options.mask.empty() && !hints.any())
        return;
    if (scene.wounds.empty())
        scene.wounds.resize(1);
    Wound& wound = scene.wounds.front();
    const Wound before = wound;
    if (!options.wound.empty())
        wound.photo = options.wound;
    wound.mask = options.mask; // drop the scene's mask: it belongs to another photo, or the hints replace it
    wound.segmentation = hints;
    follow_usual_course(before, wound);
    if (wound.photo.empty())
        throw base::InputError(options.mask.empty() ? "--seed, --rect" : "--mask", "is given without a photo",
                               "name the photo it belongs to with --wound");
}

} // namespace

Scene chosen_scene(const SceneOptions& options)
{
    Scene scene = options.scene.empty() ? Scene{} : read_scene(options.scene);
    if (!options.head.empty())
        scene.head = options.head;
    override_wound(options, scene);
    if (!options.days.empty())
        scene.days = parse_days(options.days, "--days");
    if (!options.size.empty())
        scene.size = parse_size(options.size, "--size");
    if (options.msaa)
        scene.samples = 4;
    if (options.mode == "published")
        make_published(scene);
    return scene;
}

void add_model_option(CLI::App& command, optics::ReflectanceModel& model)
{
    std::vector<std::string> names;
    for (const optics::ReflectanceModel one : optics::all_reflectance_models())
        names.emplace_back(optics::name(one));
    command
        .add_option_function<std::string>(
            "--model", [&model](const std::string& text) { model = optics::reflectance_model_named(text); },
            "Reflectance model")
        ->check(CLI::IsMember(names))
        ->default_str(std::string(optics::name(model)));
}

} // namespace scene
