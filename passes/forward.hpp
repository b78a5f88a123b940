// Draws the head: albedo and normal map, wounds projected in object space, the blend of eq. (4) and the
// shading of eq. (8). Triangles that no wound touches are drawn by a variant that knows no wounds; a term
// that is off is not compiled in.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/graph.hpp"
#include "passes/canvas.hpp"
#include "passes/head.hpp"
#include "passes/placement.hpp"
#include "passes/reflectance_lut.hpp"
#include "passes/wound_texture.hpp"
#include "shaders/shared/frame.h"
#include "shaders/shared/shadow.h"
#include "wound/shading.hpp"

namespace passes {

/// What the forward pass computes: the coefficients and models of wound::Shading, and which terms are on.
/// Each switch is a specialisation constant of the shader: off costs nothing.
struct Shading
{
    wound::Shading model;
    wound::BlendModel blend = wound::BlendModel::Corrected;
    bool lambert = true, translucency = true, ward = true;
    bool normal_map = true, shadow = true;
    glm::vec3 ambient{0}; // linear radiance of the surroundings; 0 leaves the term out
    bool operator==(const Shading&) const = default;
};

struct Camera
{
    glm::dvec3 eye{0, 0, 1}, target{0, 0, 0}; // metres
    double fov_deg = 20;                      // vertical
};
/// To the camera's own coordinates: x right, y up, z towards the viewer.
glm::dmat4 view_from_world(const Camera& camera);
/// What a tile of the picture sees (the whole, when the canvas is no tile). Depth range fitted to a head of
/// these bounds.
shared::View make_view(const Camera& camera, const Head& head, const Canvas& canvas);

/// The direction, not of unit length, from the eye through a place of the picture: x from -1 (left) to 1, y
/// from -1 (top) to 1.
glm::dvec3 sight_through(const Camera& camera, double x, double y, double aspect);

struct PlacedWound
{
    Anchor anchor;
    WoundTexture texture;
    ReflectanceLut lut;
    shared::LutAxes axes; // of the lut
    const wound::WoundDay* today = nullptr;
};

/// As the shaders read them (project_wound() and add_wound() in shaders/lib/wound_projection.glsl).
struct WoundUniform
{
    shared::WoundFrame frames[shared::MAX_WOUNDS];
};
WoundUniform wound_frames(std::span<const PlacedWound> wounds);

struct ForwardInput
{
    const Head& head;
    std::span<const PlacedWound> wounds;  // at most shared::MAX_WOUNDS
    std::span<const wound::Light> lights; // at most shared::MAX_LIGHTS; the first casts the shadow
    std::optional<shared::Shadow> shadow; // none: no shadow is cast
    engine::ImageId shadow_depth;         // used with `shadow`
    bool every_frame = true;              // run even when nothing has changed
};

/// Adds one raster pass; the result is linear radiance, RGBA16F, alpha 1 on the head
/// and 0 beside it; at its edges, radiance is premultiplied. `samples` is 1 or 4; with 4 the result is
/// resolved.
engine::ImageId add_forward(engine::Graph& graph, const ForwardInput& input, const shared::View& view,
                            const Shading& shading, const engine::ImageDesc& target);

} // namespace passes
