// The command-line options that every command on a scene shares: the scene file and what overrides its
// fields.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "apps/scene.hpp"
#include "engine/device.hpp"

namespace app {

/// --seed X,Y and --rect X,Y,W,H: where in a photograph the wound is.
struct HintOptions
{
    std::vector<int> seed, rect;
    /// Throws cicatrix::InputError when there is a mask, too.
    wound::SegmentationHints hints(const std::string& mask) const;
};
void add_hint_options(CLI::App& command, HintOptions& options);

struct SceneOptions
{
    std::string scene, head, wound, mask, days, size, mode, device;
    HintOptions hints;
    bool msaa = false, validation = false;
};

void add_scene_options(CLI::App& command, SceneOptions& options);

/// The scene with the overrides applied. Throws cicatrix::InputError.
Scene chosen_scene(const SceneOptions& options);
engine::DeviceOptions device_options(const SceneOptions& options);

/// Everything as the paper prints it: equations, contraction alone, one light without falloff, no shadow, no
/// ambient light.
void make_published(Scene& scene);

} // namespace app
