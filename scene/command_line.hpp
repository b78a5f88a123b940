// Command-line options shared by all commands on a scene: the scene file and overrides of its fields.
#pragma once
#include <string>
#include <vector>

#include "wound/optics/reflectance.hpp"
#include "wound/photo/segmentation.hpp"

namespace CLI {
class App;
}

namespace scene {
struct Scene;

/// --seed X,Y and --rect X,Y,W,H: where in a photograph the wound is.
struct HintOptions
{
    std::vector<int> seed, rect;
    /// Throws base::InputError if `mask` and a hint are both given.
    wound::SegmentationHints hints(const std::string& mask) const;
};
void add_hint_options(CLI::App& command, HintOptions& options);

struct SceneOptions
{
    std::string scene, head, wound, mask, days, size, mode, device;
    HintOptions hints;
    bool msaa = false, validation = false;
};

/// What is shown: the scene file, and what overrides its fields.
void add_scene_choice(CLI::App& command, SceneOptions& options);
/// That, the days, and how and on which device they are drawn.
void add_scene_options(CLI::App& command, SceneOptions& options);

/// The scene with the overrides applied. Throws base::InputError.
Scene chosen_scene(const SceneOptions& options);

/// `--model`, one of all reflectance models; `model` holds the default.
void add_model_option(CLI::App& command, optics::ReflectanceModel& model);

} // namespace scene
