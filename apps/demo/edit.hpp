// The edits that the demo's gestures and buttons make to a scene. Pure functions: no window, no device.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "head/placement.hpp"
#include "scene/scene.hpp"
#include "shaders/shared/frame.h"

namespace demo_command {

/// Maps points in the head's coordinates (m) to the picture (0..1 from the upper left corner) and back.
class Sight
{
  public:
    Sight() = default;
    explicit Sight(const shared::View& view);

    /// None for a point behind the camera.
    std::optional<glm::dvec2> project(const glm::dvec3& point) const;
    /// Where the ray through picture point `at` meets the plane; none when it does not.
    std::optional<glm::dvec3> on_plane(const glm::dvec2& at, const glm::dvec3& centre,
                                       const glm::dvec3& normal) const;
    const glm::dvec3& eye() const { return eye_; }

  private:
    glm::dmat4 clip_from_world_{1}, world_from_clip_{1};
    glm::dvec3 eye_{0};
};

/// A wound's outline and its two handles, in the picture (0..1).
struct WoundOutline
{
    std::vector<glm::dvec2> ring; // corners of the outline
    glm::dvec2 centre{0}, width_handle{0}, roll_handle{0};
    bool facing = false; // the wound faces the camera
};
std::optional<WoundOutline> outline_of(const head::Anchor& anchor, const Sight& sight);
bool inside(const WoundOutline& outline, const glm::dvec2& at);

/// Twice the distance from the centre to the pointer in the wound's plane, clamped to 2..200 mm; `width_mm`
/// if the pointer misses the plane.
double dragged_width_mm(const head::Anchor& anchor, const Sight& sight, const glm::dvec2& pointer,
                        double width_mm);
/// The roll that turns the roll handle towards the pointer.
double dragged_roll_deg(const head::Anchor& anchor, const Sight& sight, const glm::dvec2& pointer,
                        double roll_deg);

/// Turns a light around the face; clamps its elevation to +-89 degrees.
void turn(scene::Direction& from, double right_deg, double up_deg);

/// Whether all settings are those of the paper (published mode).
bool is_published(const scene::Scene& scene);
/// Switches published mode on, or off: then takes from `mended` the corrected equations and coefficients that
/// published mode had replaced.
void set_published(scene::Scene& scene, bool published, const scene::Scene& mended);

/// A default wound with a seed that no other synthetic wound has; the caller sets its place.
scene::Wound next_wound(const scene::Scene& scene);

} // namespace demo_command
