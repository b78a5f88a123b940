// A scene made ready to draw. A scene is a value: update() takes a new one and makes anew only what differs.
//
//   Stage stage(device, Stage::prepare(scene));             // everything is ready
//   Scene edited = stage.scene();
//   edited.wounds[0].place = *stage.loaded().pick(stage.loaded().camera(), x, y, aspect);
//   stage.update(edited);                                   // shown by the next frame that is declared
//   if (stage.poll()) redraw();                             // what workers have finished is shown, too
//
// What takes longer than a frame (reading a head or a photograph, fitting a wound to the skin it was moved
// to) is made by workers while the picture goes on with what there is: a moved wound with the colours of its
// old place, a new photograph's wound not before it is ready. Undo is update() with an earlier scene; what
// was ready for it still is.
#pragma once
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/gpu/device.hpp"
#include "passes/frame.hpp"
#include "scene/loaded_scene.hpp"

namespace stage {

/// What one frame shows of a stage.
struct FrameRequest
{
    double day = 0;
    passes::ViewportTile tile;              // the picture, or one of its tiles
    std::optional<head::Camera> camera;     // none: the scene's
    std::optional<optics::Shading> shading; // none: the scene's
    /// Draw the head even when nothing has changed, as those who measure it want. A window does not: then
    /// nothing runs when nothing has changed (gpu::Executor::up_to_date).
    bool every_frame = true;
};

struct Frame
{
    passes::FrameImages images;
    std::shared_ptr<const std::vector<wound::WoundDay>> wounds; // on the requested day, as loaded().wounds
};

/// Used by one thread. Copies share what is on the device and whatever both show: for a second setting beside
/// the first, `Stage right = left; right.update(other)`.
class Stage
{
  public:
    /// What a scene needs of the CPU: the head, read, and the wounds, being prepared. Needs no device, so
    /// that it can be made while one is opened.
    struct Preparation
    {
        scene::Scene scene;
        std::shared_ptr<scene::WoundLoader> loader;
        std::shared_ptr<const scene::LoadedHead> head;
    };
    /// Throws base::InputError.
    static Preparation prepare(const scene::Scene& scene);

    /// Waits for what is being prepared. Throws base::InputError.
    Stage(const gpu::Device& device, const Preparation& preparation);

    /// The scene of the last update(), and what is shown of it: while workers are busy a wound may be
    /// missing.
    const scene::Scene& scene() const { return set_.loaded.scene; }
    const scene::LoadedScene& loaded() const { return set_.loaded; }

    /// Shows another scene from the next declared frame on. Cheap enough for every event of a mouse that
    /// drags something. Throws base::InputError and stays as it is when a value is out of range, a wound
    /// is off the head or a tissue file is bad; other files' errors come from poll().
    /// `dragging`: more are about to follow. Wounds are then not fitted to the skin of every place on the
    /// way, which would take the time of the frames and crowd out what undo needs; the next update() without
    /// it, of the same scene when the mouse rests, begins that.
    void update(const scene::Scene& scene, bool dragging = false);
    /// Takes what the workers have finished; true when the next frame differs by it. Throws
    /// base::InputError when one has failed: scene() is then back to the last one that was shown
    /// completely. Call it now and then while pending().
    bool poll();
    /// Whether workers are busy for the scene, so that a later frame will differ without another update().
    bool pending() const { return !set_.loaded.complete; }
    /// Waits until everything is shown as the scene has it, also after dragging. Throws as poll().
    void wait_until_complete();
    /// Lets workers begin with what another scene needs, so that update() to it waits less. Errors are
    /// reported by that update().
    void prefetch(const scene::Scene& scene) const;
    /// Shows the wounds' colours by any tissue, not only by one that a scene can name; until the next
    /// update() with another tissue.
    void set_tissue(const optics::HealingTissue& tissue);

    /// What the placed wounds are on a day. The last few days asked for are remembered.
    std::shared_ptr<const std::vector<wound::WoundDay>> wounds_on(double day) const;

    /// What a camera sees on a tile.
    shared::View view(const head::Camera& camera, const passes::ViewportTile& tile) const;

    /// Declares a frame. The graph keeps what the frame reads on the device.
    Frame declare(graph::Graph& graph, const FrameRequest& request) const;

  private:
    /// A placed wound on the device.
    struct DeviceWound
    {
        passes::WoundMaps maps;
        passes::LutTissue tissue;
    };
    /// All that a scene is on the stage. Cheap to copy: what is large is shared and never changed.
    struct Set
    {
        scene::LoadedScene loaded;
        std::shared_ptr<const passes::Head> bare, wounded; // on the device, without and with wounded parts
        std::vector<DeviceWound> wounds;                   // one per loaded.wounds
    };
    /// Uploaded maps of fitted wounds, kept for as long as the loader remembers the wound.
    struct UploadedMaps
    {
        std::weak_ptr<const scene::FittedPhotograph> photograph;
        std::vector<passes::WoundMaps> maps; // one per wound
    };
    struct KnownDay
    {
        double day = 0;
        std::shared_ptr<const std::vector<wound::WoundDay>> wounds;
    };

    Set make(const scene::Scene& scene) const;
    passes::WoundMaps maps_of(const scene::PlacedWound& wound) const;
    passes::LutTissue make_lut(const Set& set, const wound::Healing& healing) const;
    passes::LutTissue lut_of(const Set& set, const wound::Healing& healing) const;
    void accept(Set set);

    const gpu::Device* device_;
    std::shared_ptr<scene::WoundLoader> loader_;
    std::shared_ptr<std::vector<UploadedMaps>> uploaded_ = std::make_shared<std::vector<UploadedMaps>>();
    std::uint64_t seen_news_ = 0;
    bool dragging_ = false;
    Set set_, whole_;                         // whole_: the last complete one
    mutable std::deque<KnownDay> known_days_; // of set_; the last asked for first
};

/// Two stages in one picture: left of the divider (a share of the width, 0 to 1) the first, right of it the
/// second. Moving the divider runs one small pass.
graph::ImageId declare_split(graph::Graph& graph, const Stage& left, const FrameRequest& left_request,
                             const Stage& right, const FrameRequest& right_request, double divider);

} // namespace stage
