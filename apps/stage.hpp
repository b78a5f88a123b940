// A scene made ready to draw: files read, wounds prepared and placed, everything uploaded once. From then on a frame is a
// declaration and a run.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/scene.hpp"
#include "engine/device.hpp"
#include "engine/executor.hpp"
#include "passes/frame.hpp"
#include "wound/wound.hpp"

namespace app {

struct StageWound
{
    wound::PreparedWound prepared;
    wound::Healing healing;
    passes::WoundMaps maps;
    passes::Anchor anchor;
};

class Stage
{
  public:
    /// Loads and uploads. Lines for the user ("no normals: computed") go to `note`. Throws cicatrix::InputError.
    Stage(engine::Device& device, const Scene& scene, const std::function<void(const std::string&)>& note);

    const Scene& scene() const { return scene_; }
    const std::vector<StageWound>& wounds() const { return wounds_; }
    wound::WoundDay wound_on(std::size_t wound, double day) const;

    /// The scene's camera, and one that looks straight at a wound and sees `wound_widths` times its patch's width.
    passes::Camera camera() const;
    passes::Camera close_up(std::size_t wound) const;

    /// Declares the frame of one day.
    passes::FrameImages declare(engine::Graph& graph, double day, const passes::Camera& camera, const passes::Shading& shading) const;

  private:
    Scene scene_;
    std::vector<StageWound> wounds_;
    passes::Head head_;
    passes::FaceFrame face_;
    std::vector<shared::Light> lights_;
    passes::SkinTissue tissue_;
};

/// Where set-up leaves the default head: $XDG_CACHE_HOME or ~/.cache, cicatrix/.
std::filesystem::path default_head();

} // namespace app
