#include "apps/scene_options.hpp"

#include "wound/input_error.hpp"

namespace app {

void add_scene_options(CLI::App& command, SceneOptions& options)
{
    command
        .add_option("scene", options.scene,
                    "Scene file (docs/scene.md); without one: the default head with a wound on the cheek")
        ->type_name("SCENE.json");
    command.add_option("--head", options.head, "Head to use instead of the scene's")->type_name("FILE.glb");
    command.add_option("--wound", options.wound, "Photograph for the first wound")->type_name("PHOTO");
    command
        .add_option("--mask", options.mask,
                    "Mask for that photograph, white where the wound is; without one it is segmented")
        ->type_name("PICTURE");
    command.add_option("--days", options.days, "Days to show: first:last:step, or a list such as 0,5,12")
        ->type_name("DAYS");
    command.add_option("--size", options.size, "Size of the pictures, for example 1280x720")
        ->type_name("WxH");
    command
        .add_option("--mode", options.mode, "published: the paper's equations as printed; corrected: mended")
        ->check(CLI::IsMember({"published", "corrected"}));
    command.add_flag("--msaa", options.msaa, "Four samples per pixel");
    command
        .add_option("--device", options.device,
                    "Vulkan device by index or part of its name; also CICATRIX_DEVICE")
        ->type_name("NAME|INDEX");
    command.add_flag("--validation", options.validation,
                     "Run under the Vulkan validation layers; a message is a failure");
}

Scene chosen_scene(const SceneOptions& options)
{
    Scene scene = options.scene.empty() ? Scene{} : read_scene(options.scene);
    if (!options.head.empty())
        scene.head = options.head;
    if (!options.wound.empty() || !options.mask.empty()) {
        if (scene.wounds.empty())
            scene.wounds.resize(1);
        if (!options.wound.empty()) {
            scene.wounds.front().photo = options.wound;
            scene.wounds.front().mask.clear();
        }
        if (!options.mask.empty())
            scene.wounds.front().mask = options.mask;
        if (scene.wounds.front().photo.empty())
            throw cicatrix::InputError("--mask", "is given without a photo",
                                       "name the photo it belongs to with --wound");
    }
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

engine::DeviceOptions device_options(const SceneOptions& options)
{
    engine::DeviceOptions device;
    device.device = options.device;
    device.validation = options.validation;
    return device;
}

void make_published(Scene& scene)
{
    scene.shading = published_shading();
    scene.reflectance_model = wound::Rung::Published;
    scene.tissue = "table1";
    for (WoundScene& wound : scene.wounds)
        wound.healing.model = wound::HealingModel::contraction;
    if (!scene.lights.empty()) {
        scene.lights.resize(1);
        scene.lights.front().falloff = false;
    }
}

} // namespace app
