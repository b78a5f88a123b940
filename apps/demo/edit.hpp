// What the demo's gestures and buttons do to a scene. Values in, values out: no window, no device.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "head/placement.hpp"
#include "scene/scene.hpp"
#include "shaders/shared/frame.h"

namespace demo_command {

/// From the head's metres to a picture and back. Pictures are measured in 0..1 from their upper left corner.
class Sight
{
  public:
    Sight() = default;
    explicit Sight(const shared::View& view);

    /// None behind the camera.
    std::optional<glm::dvec2> project(const glm::dvec3& point) const;
    /// Where the ray through a point of the picture meets a plane; none when it never does.
    std::optional<glm::dvec3> on_plane(const glm::dvec2& at, const glm::dvec3& centre,
                                       const glm::dvec3& normal) const;
    const glm::dvec3& eye() const { return eye_; }

  private:
    glm::dmat4 clip_from_world_{1}, world_from_clip_{1};
    glm::dvec3 eye_{0};
};

/// The corners of a wound's outline and its two handles, as the viewer sees them, in 0..1 of the picture.
struct WoundOutline
{
    std::vector<glm::dvec2> ring;
    glm::dvec2 centre{0}, width_handle{0}, roll_handle{0};
    bool facing = false; // the camera
};
std::optional<WoundOutline> outline_of(const head::Anchor& anchor, const Sight& sight);
bool inside(const WoundOutline& outline, const glm::dvec2& at);

/// As wide as from the centre to the pointer on both sides; within what a scene allows.
double dragged_width_mm(const head::Anchor& anchor, const Sight& sight, const glm::dvec2& pointer,
                        double width_mm);
/// Such that the roll handle points at the pointer.
double dragged_roll_deg(const head::Anchor& anchor, const Sight& sight, const glm::dvec2& pointer,
                        double roll_deg);

/// Turns a light around the face; stays within what a scene allows.
void turn(scene::Direction& from, double right_deg, double up_deg);

/// Whether the scene is all as the paper prints it.
bool is_published(const scene::Scene& scene);
/// Makes it so, or takes the mended equations and coefficients from `mended`, as far as published mode had
/// replaced them.
void set_published(scene::Scene& scene, bool published, const scene::Scene& mended);

/// A default wound unlike those there are; the caller places it.
scene::Wound next_wound(const scene::Scene& scene);

} // namespace demo_command
