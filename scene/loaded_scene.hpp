// A scene with all that it names: the head read, the wounds prepared, fitted to the skin and placed, lights
// and cameras in the head's metres. Everything that can be known of a scene without a graphics device.
//
//   const LoadedScene loaded = load(read_scene("scene.json"));
//   for (const wound::WoundDay& wound : loaded.wounds_on(12)) ...
#pragma once
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "head/camera.hpp"
#include "scene/loader.hpp"
#include "scene/scene.hpp"
#include "wound/optics/shading.hpp"
#include "wound/optics/skin_presets.hpp"
#include "wound/wound.hpp"

namespace scene {

/// One wound where it lies on the head.
struct PlacedWound
{
    std::size_t scene_wound = 0; // index of the scene's wound that it is (a component) of
    std::shared_ptr<const FittedPhotograph> photograph;
    std::size_t part = 0; // of the photograph's wounds
    head::Anchor anchor;
    cv::Rect region; // texels of the patch outside which nothing is ever drawn; empty: none is known
    wound::Healing healing;

    const FittedWound& fitted() const { return photograph->wounds[part]; }
    const wound::PreparedWound& prepared() const { return fitted().prepared; }
};

struct LoadedScene
{
    Scene scene;
    std::shared_ptr<const LoadedHead> head;
    std::vector<PlacedWound> wounds;
    std::vector<optics::Light> lights;
    optics::HealingTissue tissue;
    std::vector<std::string> notes; // lines for the user ("no normals: computed")

    /// Whether nothing of it is being made: no wound is missing, or stands in for one that is.
    bool complete = false;
    /// The wounds that are shown, those of an earlier scene while this one's head is being read, and their
    /// photographs; null where there is nothing to show yet.
    std::vector<Wound> shown;
    std::vector<std::shared_ptr<const FittedPhotograph>> photographs;

    /// What the placed wounds are on a day.
    std::vector<wound::WoundDay> wounds_on(double day) const;
    /// The head's surface in mm2 under each texel of a wound's maps (head/albedo_under.hpp), of its region.
    cv::Mat1f surface_mm2(std::size_t wound) const;
    std::vector<head::Anchor> anchors() const;

    /// The scene's camera.
    head::Camera camera() const { return camera(scene.camera); }
    head::Camera camera(const Camera& from) const;
    /// From a scene's camera to what it looks at, metres; also when the scene leaves it to the head's size.
    double distance(const Camera& from) const;
    /// Looks straight at a placed wound, or at the face's middle in a head without any.
    head::Camera close_up(std::size_t wound) const;
    /// The middle of the skull, about which a camera that goes round the head turns; straight behind the
    /// middle of the face, at which camera() looks.
    glm::dvec3 head_middle() const;

    /// The point of the skin, in the head's metres, that is seen at a place of the picture: x from -1 (left)
    /// to 1, y from -1 (top) to 1. None where the head is not, or where an eye or a garment is. It is a place
    /// for a wound as it stands.
    std::optional<glm::dvec3> pick(const head::Camera& camera, double x, double y, double aspect) const;
    /// The scene's wound whose mask is at the point or at most `tolerance_m` beside it, the nearest of
    /// several; none when there is none so near.
    std::optional<std::size_t> wound_near(const glm::dvec3& point, double tolerance_m = 0.002) const;
};

/// Begins loading what a scene needs: reads the head and leaves the wounds to the loader's workers. Throws
/// base::InputError.
std::shared_ptr<const LoadedHead> begin_loading(WoundLoader& loader, const Scene& scene);

/// The scene as far as the loader has it now; work on what is missing is begun. What is not ready is stood in
/// for by what `before` shows, of which at least the head must be there, or by the same photograph fitted to
/// another place. `dragging`: more edits are about to follow, so no work is begun. Throws base::InputError.
LoadedScene assemble(const Scene& scene, WoundLoader& loader, const LoadedScene& before, bool dragging);

/// The scene, complete. Throws base::InputError.
LoadedScene load(const Scene& scene);

/// From the face's middle; unit length.
glm::dvec3 unit_towards(const Direction& from);

/// Metres, in the head's coordinates.
glm::dvec3 face_middle(const head::FaceFrame& face);

} // namespace scene
