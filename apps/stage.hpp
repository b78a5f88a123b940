// A scene made ready to draw. A scene is a value: update() takes a new one and makes anew only what differs.
//
//   Stage stage(device, scene, Stage::prepare(scene));      // everything is ready
//   Scene edited = stage.scene();
//   edited.wounds[0].place = *stage.pick(stage.camera(), x, y, aspect);
//   stage.update(edited);                                   // shown by the next frame that is declared
//   if (stage.poll()) redraw();                             // what workers have finished is shown, too
//
// What takes longer than a frame (reading a head or a photograph, fitting a wound to the skin it was moved
// to) is made by workers while the picture goes on with what there is: a moved wound with the colours of its
// old place, a new photograph's wound not before it is ready. Undo is update() with an earlier scene; what
// was ready for it still is.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene.hpp"
#include "apps/stage_wounds.hpp"
#include "engine/device.hpp"
#include "passes/frame.hpp"
#include "wound/skin_presets.hpp"
#include "wound/wound.hpp"

namespace app {

class Stage
{
  public:
    /// What a scene needs of the CPU: the head, read, and the wounds, being prepared. Needs no device, so
    /// that it can be made while one is opened. Throws cicatrix::InputError.
    struct Props
    {
        Scene scene;
        std::shared_ptr<Workshop> workshop;
        std::shared_ptr<const LoadedHead> head;
        /// Waits for the scene's wounds. Throws cicatrix::InputError.
        std::vector<std::shared_ptr<Fit>> wounds() const;
    };
    static Props prepare(const Scene& scene);

    /// Waits for what is being prepared. Throws cicatrix::InputError.
    Stage(const engine::Device& device, const Scene& scene, const Props& props);
    // A copy shares with the original what is on the device and whatever both show; for a second setting
    // beside the first: `Stage right = left; right.update(other)`.

    /// The scene of the last update().
    const Scene& scene() const { return set_.scene; }
    /// Lines for the user ("no normals: computed").
    const std::vector<std::string>& notes() const { return set_.notes; }
    /// The placed wounds that are shown, and for each the index of the scene's wound that it is (a component)
    /// of. While workers are busy a wound of the scene may be missing.
    const std::vector<wound::PreparedWound>& prepared() const { return set_.prepared; }
    const std::vector<std::size_t>& scene_wounds() const { return set_.scene_wounds; }
    const std::vector<passes::Anchor>& anchors() const { return set_.anchors; }
    const engine::Model& head() const { return *set_.head->model; }
    /// The head's surface in mm2 under each texel of a placed wound's maps of today (passes/skin_under.hpp).
    cv::Mat1f surface_mm2(std::size_t wound) const;

    /// Shows another scene from the next declared frame on. Cheap enough for every event of a mouse that
    /// drags something. Throws cicatrix::InputError and stays as it is when a value is out of range, a wound
    /// is off the head or a tissue file is bad; other files' errors come from poll().
    /// `dragging`: more are about to follow. Wounds are then not fitted to the skin of every place on the
    /// way, which would take the time of the frames and crowd out what undo needs; the next update() without
    /// it, of the same scene when the mouse rests, begins that.
    void update(const Scene& scene, bool dragging = false);
    /// Takes what the workers have finished; true when the next frame differs by it. Throws
    /// cicatrix::InputError when one has failed: scene() is then back to the last one that was shown
    /// completely. Call it now and then while pending().
    bool poll();
    /// Whether workers are busy for the scene, so that a later frame will differ without another update().
    bool pending() const { return !set_.complete; }
    /// Waits until everything is shown as the scene has it, also after dragging. Throws as poll().
    void settle();
    /// Lets workers begin with what another scene needs, so that update() and settle() wait less for it. What
    /// is wrong with it is told then.
    void foresee(const Scene& scene) const;
    /// Shows the wounds' colours by any tissue, not only by one that a scene can name; until the next
    /// update() with another tissue.
    void set_tissue(const wound::HealingTissue& tissue);

    /// What the placed wounds are on a day. `today` computes it once for a day and costs nothing when asked
    /// again; it belongs to one thread.
    std::vector<wound::WoundDay> wounds_on(double day) const;
    const std::vector<wound::WoundDay>& today(double day);

    /// The scene's camera.
    passes::Camera camera() const { return camera(set_.scene.camera); }
    passes::Camera camera(const CameraScene& from) const;
    /// From a scene's camera to what it looks at, metres; also when the scene leaves it to the head's size.
    double distance(const CameraScene& from) const;
    /// Looks straight at a placed wound, or at the face's middle in a head without any.
    passes::Camera close_up(std::size_t wound) const;

    /// The middle of the skull, about which a camera that goes round the head turns; straight behind the
    /// middle of the face, at which camera() looks.
    glm::dvec3 head_middle() const;
    /// What a camera sees on a canvas.
    shared::View view(const passes::Camera& camera, const passes::Canvas& canvas) const;

    /// The point of the skin, in the head's metres, that is seen at a place of the picture: x from -1 (left)
    /// to 1, y from -1 (top) to 1. None where the head is not, or where an eye or a garment is. It is a place
    /// for a wound as it stands.
    std::optional<glm::dvec3> pick(const passes::Camera& camera, double x, double y, double aspect) const;
    /// The scene's wound whose mask is at the point or at most `tolerance_m` beside it, the nearest of
    /// several; none when there is none so near.
    std::optional<std::size_t> wound_near(const glm::dvec3& point, double tolerance_m = 0.002) const;

    /// Declares the frame of one day. `canvas`: the picture's size, or one of its tiles. The forward
    /// pass runs every frame.
    passes::FrameImages declare(engine::Graph& graph, const std::vector<wound::WoundDay>& today,
                                const passes::Camera& camera, const passes::Shading& shading,
                                const passes::Canvas& canvas) const;
    /// The same by the scene's own camera and shading, for a window: nothing runs when nothing has changed
    /// (engine::Executor::up_to_date).
    passes::FrameImages declare(engine::Graph& graph, double day, const passes::Canvas& canvas);

  private:
    /// All that a scene is on the stage. Cheap to copy: what is large is shared and never changed.
    struct Set
    {
        Scene scene;
        std::vector<WoundScene> placed;         // scene.wounds; those before while their head is being read
        std::vector<std::shared_ptr<Fit>> fits; // one per placed; null until there is something to show
        std::shared_ptr<const LoadedHead> head;
        std::shared_ptr<const passes::Head> bare, wounded; // on the device, without and with wounded parts
        wound::HealingTissue tissue;
        std::vector<std::string> notes;
        std::vector<wound::Light> lights;
        // One entry per placed wound.
        std::vector<std::size_t> scene_wounds;
        std::vector<passes::Anchor> anchors;
        std::vector<wound::PreparedWound> prepared;
        std::vector<passes::SceneWound> wounds;
        bool complete = false; // nothing is being made
    };
    Set make(const Scene& scene) const;
    void place_wounds(Set& set) const;
    void place_wound(Set& set, std::size_t index, Fit& fit, const std::string& name, bool exact) const;
    passes::LutTissue make_lut(const Set& set, const wound::Healing& healing) const;
    passes::LutTissue lut_of(const Set& set, const wound::Healing& healing) const;
    passes::FrameImages declare(engine::Graph& graph, const passes::FrameInput& input) const;
    void accept(Set set);

    const engine::Device* device_;
    std::shared_ptr<Workshop> workshop_;
    std::uint64_t seen_news_ = 0;
    bool dragging_ = false;
    Set set_, whole_; // whole_: the last complete one
    /// Which wound on which day wounds_today_ holds; a border tells a wound's shape.
    struct Today
    {
        double day = -1;
        wound::Healing healing;
        std::vector<cv::Point2d> border;
        bool operator==(const Today&) const = default;
    };
    std::vector<Today> today_;
    std::vector<wound::WoundDay> wounds_today_;
};

/// Two stages in one picture: left of the divider (a share of the width, 0 to 1) the first, right of it the
/// second. Moving the divider runs one small pass.
engine::ImageId declare_split(engine::Graph& graph, Stage& left, double left_day, Stage& right,
                              double right_day, const passes::Canvas& canvas, double divider);

} // namespace app
