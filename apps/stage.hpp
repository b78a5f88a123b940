// A scene made ready to draw: files read, wounds prepared and placed, everything uploaded once. From then on
// a frame is a declaration and a run.
#pragma once
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "apps/scene.hpp"
#include "engine/device.hpp"
#include "passes/frame.hpp"
#include "wound/skin_presets.hpp"
#include "wound/wound.hpp"

namespace app {

class Stage
{
  public:
    /// What a scene needs of the CPU: the head and the wounds, read and prepared. Needs no device, so that it
    /// can be made while one is opened. Lines for the user ("no normals: computed") are collected in `notes`.
    /// Throws cicatrix::InputError.
    struct Props
    {
        std::shared_ptr<const engine::Model> head;
        passes::FaceFrame face;
        // One entry per placed wound: a mask of several components makes several of one of the scene's.
        std::vector<std::size_t> scene_wounds; // which of the scene's it comes from
        std::vector<passes::Anchor> anchors;
        std::vector<std::future<wound::PreparedWound>> wounds; // being matched to the skin they lie on
        wound::HealingTissue tissue;
        std::vector<std::string> notes;
    };
    static Props prepare(const Scene& scene);

    Stage(const engine::Device& device, const Scene& scene, Props props);

    const Scene& scene() const { return scene_; }
    const std::vector<std::string>& notes() const { return props_.notes; }
    /// The placed wounds, and for each the index of the scene's wound that it is (a component) of.
    const std::vector<wound::PreparedWound>& prepared() const { return prepared_; }
    const std::vector<std::size_t>& scene_wounds() const { return props_.scene_wounds; }
    const engine::Model& head() const { return *props_.head; }
    const std::vector<passes::Anchor>& anchors() const { return props_.anchors; }
    /// The head's surface in mm2 under each texel of a wound's maps of today (passes/skin_under.hpp).
    cv::Mat1f surface_mm2(std::size_t wound) const;
    std::vector<wound::WoundDay> wounds_on(double day) const;
    /// From the next frame on. Throws cicatrix::InputError and keeps the old ones when one is out of range.
    void set_lights(const std::vector<LightScene>& lights);

    /// The same for the tissue that gives the wounds their colours: any, not only one that a scene can name.
    void set_tissue(const wound::HealingTissue& tissue);

    /// The scene's camera.
    passes::Camera camera() const { return camera(scene_.camera); }
    passes::Camera camera(const CameraScene& from) const;
    /// Looks straight at a wound, or at the face's middle in a head without any.
    passes::Camera close_up(std::size_t wound) const;

    /// The middle of the skull, about which a camera that goes round the head turns; straight behind the
    /// middle of the face, at which camera() looks.
    glm::dvec3 head_middle() const;
    /// What a camera sees on a canvas.
    shared::View view(const passes::Camera& camera, const passes::Canvas& canvas) const;

    /// Declares the frame of one day. `canvas`: the picture's size, or one of its tiles.
    passes::FrameImages declare(engine::Graph& graph, const std::vector<wound::WoundDay>& today,
                                const passes::Camera& camera, const passes::Shading& shading,
                                const passes::Canvas& canvas) const;

  private:
    const wound::Healing& healing(std::size_t wound) const; // of a placed wound
    passes::LutTissue table_tissue(std::size_t wound) const;

    Scene scene_;
    Props props_;
    std::vector<wound::PreparedWound> prepared_;
    passes::Head head_;
    std::vector<passes::SceneWound> wounds_;
    std::vector<wound::Light> lights_;
};

} // namespace app
