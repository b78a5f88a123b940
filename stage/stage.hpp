// Prepares a scene for drawing. A scene is a value: update() takes a new one and recomputes what differs.
//
//   Stage stage(device, Stage::prepare(scene));             // waits until everything is ready
//   Scene edited = stage.scene();
//   edited.wounds[0].place = *stage.loaded().pick(stage.loaded().camera(), x, y, aspect);
//   stage.update(edited);                                   // the next declared frame shows it
//   if (stage.poll()) redraw();                             // workers have finished something
//
// Worker threads do what takes longer than a frame (reading a head or a photograph, fitting a wound to the
// skin it was moved to). Meanwhile frames show what is ready: a moved wound keeps the colours of its old
// place, and a wound of a new photograph appears when it is ready. Undo is update() with an earlier scene;
// its prepared data is cached.
#pragma once
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/gpu/device.hpp"
#include "passes/frame.hpp"
#include "scene/loaded_scene.hpp"
#include "wound/optics/transport.hpp"

namespace stage {

/// The parameters of one frame of a stage.
struct FrameRequest
{
    double day = 0;
    passes::ViewportTile tile;              // the whole picture or one tile
    std::optional<head::Camera> camera;     // none: the scene's
    std::optional<optics::Shading> shading; // none: the scene's
    /// Draw the head even when nothing has changed, for measurements. A window sets it to false, so that no
    /// pass runs when nothing has changed (gpu::Executor::up_to_date).
    bool every_frame = true;
    /// Scale of the skin's atlas on which light is kept for this and further frames with the same light: this
    /// one costs more, those less. Stage::light_scale(); none: light is computed in every pixel.
    std::optional<double> light_scale;
    bool radiance = true; // FrameImages::radiance is needed
    /// The lights stand. While they are dragged transport `diffused` is drawn as `preintegrated`, which needs
    /// no time when lights change.
    bool lights_rest = true;
};

struct Frame
{
    passes::FrameImages images;
    std::shared_ptr<const std::vector<wound::WoundDay>> wounds; // on the requested day, like loaded().wounds
};

/// For use by one thread. Copies share device data and everything that they have in common: for a second
/// setting beside the first, `Stage right = left; right.update(other)`.
class Stage
{
  public:
    /// The CPU data of a scene: the loaded head, and the wounds that the loader is preparing. Needs no
    /// device, so that it can be made while a device is opened.
    struct Preparation
    {
        scene::Scene scene;
        std::shared_ptr<scene::WoundLoader> loader;
        std::shared_ptr<const scene::LoadedHead> head;
    };
    /// Throws base::InputError.
    static Preparation prepare(const scene::Scene& scene);

    /// Waits until the preparation is complete. Throws base::InputError.
    Stage(const gpu::Device& device, const Preparation& preparation);

    /// The scene of the last update(), and its loaded data; a wound may be missing while workers are busy.
    const scene::Scene& scene() const { return set_.loaded.scene; }
    const scene::LoadedScene& loaded() const { return set_.loaded; }

    /// Shows another scene from the next declared frame on. Fast enough to call for every mouse event of a
    /// drag. Throws base::InputError and changes nothing when a value is out of range, a wound is off the
    /// head or a tissue file is invalid; poll() reports errors of other files.
    ///
    /// `dragging`: more updates will follow, so wounds are not fitted to the skin of each intermediate place,
    /// which would slow the frames down and evict cached data that undo needs. The next update() without it,
    /// with the same scene when the mouse rests, starts the fitting.
    void update(const scene::Scene& scene, bool dragging = false);
    /// Collects the workers' results; true when they change the next frame. Throws base::InputError when a
    /// worker has failed: scene() is then the last completely shown scene again. Call it regularly while
    /// pending().
    bool poll();
    /// Whether workers still prepare data of the scene, so that a later frame will differ without update().
    bool pending() const { return !set_.loaded.complete; }
    /// Waits until all data of the scene is ready, also after dragging. Throws like poll().
    void wait_until_complete();
    /// Starts workers on the data of another scene, so that it is ready sooner after update(). Errors are
    /// reported by that update().
    void prefetch(const scene::Scene& scene) const;
    /// Recomputes the wounds' colours for any tissue, also one that a scene cannot name; holds until the next
    /// update() with another tissue.
    void set_tissue(const optics::HealingTissue& tissue);

    /// The states of the placed wounds on a day. The last few requested days are cached.
    std::shared_ptr<const std::vector<wound::WoundDay>> wounds_on(double day) const
    {
        return known_day(day).wounds;
    }

    /// The view of a camera for a tile.
    shared::View view(const head::Camera& camera, const passes::ViewportTile& tile) const;

    /// The scale of the skin's atlas at which light is kept for this camera and height of the picture,
    /// pixels; none when it is computed in every pixel because the head has no usable skin or the camera is
    /// too near.
    std::optional<double> light_scale(const head::Camera& camera, std::uint32_t height) const;

    /// ViewportTile::apron of tiles of such a picture, even: how far a pixel's light spreads in the picture.
    std::uint32_t apron(const head::Camera& camera, std::uint32_t height) const;

    /// Declares a frame. The graph keeps the device data that the frame reads alive.
    Frame declare(graph::Graph& graph, const FrameRequest& request) const;

  private:
    /// A placed wound on the device.
    struct DeviceWound
    {
        passes::WoundMaps maps;
        std::shared_ptr<const passes::LutTissue> tissue; // shared by the wounds with the same table
    };
    /// A scene's data on the CPU and the device. Cheap to copy: large data is shared and immutable.
    struct Set
    {
        scene::LoadedScene loaded;
        std::shared_ptr<const passes::Head> bare, wounded; // the head without and with wounded parts
        std::vector<DeviceWound> wounds;                   // one per loaded.wounds
        std::vector<passes::WoundReach> reaches;           // the same
    };
    /// Uploaded maps of a photograph's wounds, kept while the photograph is alive.
    struct UploadedMaps
    {
        std::weak_ptr<const scene::FittedPhotograph> photograph;
        std::vector<passes::WoundMaps> maps; // one per wound
    };
    struct KnownDay
    {
        double day = 0;
        std::shared_ptr<const std::vector<wound::WoundDay>> wounds;
        std::shared_ptr<const std::vector<passes::PackedWarps>> warps; // the same
    };

    KnownDay known_day(double day) const;
    Set make(const scene::Scene& scene) const;
    passes::WoundMaps maps_of(const scene::PlacedWound& wound) const;
    using SharedTissue = std::shared_ptr<const passes::LutTissue>;
    SharedTissue make_lut(const Set& set, const scene::PlacedWound& wound) const;
    SharedTissue lut_of(const Set& set, const scene::PlacedWound& wound) const;
    void accept(Set set);
    /// The skin with the wounds of set_; null for a head without a usable one.
    const passes::Skin* skin() const;
    /// Of the tissue; 0 for a shading whose transport does not use it.
    optics::TissueSpread tissue_spread(const optics::Shading& shading) const;

    const gpu::Device* device_;
    std::shared_ptr<scene::WoundLoader> loader_;
    std::shared_ptr<std::vector<UploadedMaps>> uploaded_ = std::make_shared<std::vector<UploadedMaps>>();
    std::uint64_t seen_news_ = 0;
    bool dragging_ = false;
    Set set_, whole_; // whole_: the last complete set
    /// Of a head and its wounds, once a frame has asked for it.
    struct SpreadHead
    {
        std::shared_ptr<const passes::Head> bare, wounded;
        head::BaseAtlas base;
        head::AtlasSurface surface; // of `base`, with skirts
        std::shared_ptr<const passes::Skin> skin;
    };
    mutable SpreadHead spread_;
    mutable std::optional<optics::TissueSpread>
        tissue_spread_;                       // of set_'s tissue, once a frame has asked for it
    mutable std::deque<KnownDay> known_days_; // of set_, most recently requested first
};

/// Declares two stages in one picture: `left` left of the divider (share of the width, 0 to 1), `right` right
/// of it. Moving the divider runs only one small pass.
graph::ImageId declare_split(graph::Graph& graph, const Stage& left, const FrameRequest& left_request,
                             const Stage& right, const FrameRequest& right_request, double divider);

} // namespace stage
