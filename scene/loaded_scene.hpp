// A scene with its data loaded, without a graphics device: the head, the wounds prepared, fitted to the skin
// and placed, and lights and cameras in the head's coordinates, in metres.
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

/// One wound and its placement on the head.
struct PlacedWound
{
    std::size_t scene_wound = 0; // index in LoadedScene::shown; several components share one
    std::shared_ptr<const FittedPhotograph> photograph;
    std::size_t part = 0; // index in photograph->wounds
    head::Anchor anchor;
    cv::Rect region; // drawn_region() in texels of the patch; empty: not known
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

    /// Whether head and wounds are those of `scene`; false while a worker is still making one of them.
    bool complete = false;
    /// The wounds that are shown (those of the previous scene while this one's head is being read) and their
    /// photographs, null for a wound that cannot be shown yet.
    std::vector<Wound> shown;
    std::vector<std::shared_ptr<const FittedPhotograph>> photographs;

    /// The tissue at a placed wound (wound::at_place()).
    optics::HealingTissue tissue_at(const PlacedWound& wound) const
    {
        return wound::at_place(tissue, wound.fitted().thickness);
    }
    /// Whether the tissue of both heals alike, so that one reflectance table serves both.
    bool same_tissue(const PlacedWound& a, const PlacedWound& b) const;
    /// The state of each placed wound on a day.
    std::vector<wound::WoundDay> wounds_on(double day) const;
    /// The head's surface in mm^2 under each texel of a placed wound's region (head/albedo_under.hpp).
    cv::Mat1f surface_mm2(std::size_t wound) const;
    std::vector<head::Anchor> anchors() const;

    /// The scene's camera.
    head::Camera camera() const { return camera(scene.camera); }
    head::Camera camera(const Camera& from) const;
    /// Distance of a scene's camera from its target, m; computed from the head's size if distance_m is 0.
    double distance(const Camera& from) const;
    /// Looks at a placed wound from close by; the scene's camera if there is no such wound.
    head::Camera close_up(std::size_t wound) const;
    /// The middle of the skull, about which cameras orbit; straight behind the face's middle, at which
    /// camera() looks.
    glm::dvec3 head_middle() const;

    /// The visible point of the skin, in the head's coordinates in metres, at a position in the picture: x
    /// from -1 (left) to 1, y from -1 (top) to 1. nullopt on the background, an eye or a garment. A wound can
    /// be placed at the point.
    std::optional<glm::dvec3> pick(const head::Camera& camera, double x, double y, double aspect) const;
    /// Index of the scene's wound whose mask contains the point or is at most `tolerance_m` from it; of
    /// several the one with the nearest centre; nullopt if there is none.
    std::optional<std::size_t> wound_near(const glm::dvec3& point, double tolerance_m = 0.002) const;
};

/// Starts loading a scene: reads the head and starts the loader's workers on the wounds. Throws
/// base::InputError.
std::shared_ptr<const LoadedHead> begin_loading(WoundLoader& loader, const Scene& scene);

/// The scene as far as it is loaded; starts work on missing parts. A part that is not ready is replaced by
/// that of `before`, whose head must exist, or by the same photograph fitted to another place. `dragging`:
/// more edits follow soon, so no fitting is started. Throws base::InputError.
LoadedScene assemble(const Scene& scene, WoundLoader& loader, const LoadedScene& before, bool dragging);

/// The scene, complete. Throws base::InputError.
LoadedScene load(const Scene& scene);

/// Unit vector from the face's middle.
glm::dvec3 unit_towards(const Direction& from);

/// In the head's coordinates, m.
glm::dvec3 face_middle(const head::FaceFrame& face);

} // namespace scene
