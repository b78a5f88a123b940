// Draws the head: albedo and normal map, wounds projected in object space, the blend of eq. (4) and the
// shading of eq. (8). Triangles that no wound touches use a shader variant without wounds; a shading term
// that is off is not compiled.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/graph/graph.hpp"
#include "head/camera.hpp"
#include "head/placement.hpp"
#include "passes/head.hpp"
#include "passes/reflectance_lut.hpp"
#include "passes/shadow.hpp"
#include "passes/viewport_tile.hpp"
#include "passes/wound_texture.hpp"
#include "shaders/shared/frame.h"
#include "shaders/shared/skin.h"
#include "wound/optics/shading.hpp"

namespace passes {

/// The view of a tile, or of the whole picture if `tile` covers it. The depth range is fitted to the head's
/// bounds.
shared::View make_view(const head::Camera& camera, const Head& head, const ViewportTile& tile);

struct ForwardWound
{
    head::Anchor anchor;
    WoundTexture texture;
    ReflectanceLut lut;
    shared::LutAxes axes; // of `lut`
    const wound::WoundDay* today = nullptr;
    std::uint32_t index = 0; // in with_wounds()
};

/// The uniform block of a draw's wounds, read by project_wound() and add_wound()
/// (shaders/lib/wound_projection.glsl).
struct WoundUniform
{
    shared::WoundFrame frames[shared::WOUNDS_HERE];
};
WoundUniform wound_frames(std::span<const ForwardWound> wounds); // at most shared::WOUNDS_HERE

struct Skin;
struct SkinLight;
struct DiffusedLight;

struct ForwardInput
{
    const Head& head;
    std::span<const ForwardWound> wounds;
    std::span<const optics::Light> lights;     // at most shared::MAX_LIGHTS
    Shadows shadows;                           // of the lights
    graph::ImageId shadow_depth;               // used when a light casts a shadow
    bool every_frame = true;                   // run the pass even when nothing has changed
    base::Color scattering_length_mm{0, 0, 0}; // of the skin (optics/transport.hpp)
    const Skin* skin = nullptr;                // of `head`, for what follows
    std::span<const ForwardWound> placed{};    // on it, whether the camera sees them or not
    const SkinLight* kept = nullptr;           // light on the skin; null: computed in every pixel
    const DiffusedLight* around = nullptr;     // of transport `diffused`; null: drawn as `preintegrated`
    std::optional<shared::Develop> developed;  // for opaque parts, a backdrop and one sample
    bool apart = false;                        // hand out LightApart; without kept, around and developed
};

/// What the camera sees of opaque skin, before its light has spread. Per pixel, weighted by the share of the
/// pixel that is such skin; with several samples the means of theirs.
struct LightApart
{
    graph::ImageId received;    // rgb: diffuse light per reflectance; a: share that is no skin; RGBA16F
    graph::ImageId reflectance; // rgb: rho_d C; RGBA16F
    graph::ImageId distance;    // m, along the camera's axis; R32F
    graph::Region wounded;      // what a new day can change; empty: unknown
};

struct ForwardImages
{
    graph::ImageId radiance; // without the diffuse light of `apart`
    std::optional<LightApart> apart;
};

/// Adds one raster pass. The result is linear radiance premultiplied by alpha, RGBA16F; alpha is 1 on the
/// head and 0 beside it. With `developed` it is the picture, RGBA8, sRGB-coded, as add_tonemap() makes it.
/// `target.samples` is 1 or 4; with 4 the result is resolved.
ForwardImages add_forward(graph::Graph& graph, const ForwardInput& input, const shared::View& view,
                          const optics::Shading& shading, const graph::ImageDesc& target);

} // namespace passes
