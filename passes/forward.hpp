// Draws the head: albedo and normal map, wounds projected in object space, the blend of eq. (4) and the shading of eq. (8).
// Triangles that no wound touches are drawn by a variant that knows no wounds; a term that is off is not compiled in.
#pragma once
#include <span>

#include "engine/graph.hpp"
#include "passes/head.hpp"
#include "passes/placement.hpp"
#include "passes/reflectance_lut.hpp"
#include "passes/wound_texture.hpp"
#include "shaders/shared/frame.h"
#include "shaders/shared/shading.h"

namespace passes {

/// Which terms are computed and by which of their siblings; each field is a specialisation constant of the shader.
struct Shading
{
    bool lambert = true, translucency = true, ward = true;
    bool normal_map = true, shadow = true;
    std::uint32_t ward_model = 2;         // WARD_*, shaders/shared/shading.h
    std::uint32_t translucency_model = 1; // TRANSLUCENCY_*
    std::uint32_t blend_model = 1;        // BLEND_*
    shared::ShadingParams params;
};

struct PlacedWound
{
    Anchor anchor;
    WoundTexture texture;
    shared::WoundFrame frame;
};

struct ForwardInput
{
    const Head& head;
    std::span<const PlacedWound> wounds; // at most shared::MAX_WOUNDS
    ReflectanceLut lut;                  // used when there are wounds
    engine::ImageId shadow;              // used when shading.shadow
    std::span<const shared::Light> lights;
};

/// Adds one raster pass at the given size; the result is linear radiance, RGBA16F, alpha 1 on the head and 0 beside it.
engine::ImageId add_forward(engine::Graph& graph, const ForwardInput& input, const shared::View& view, const Shading& shading,
                            const engine::ImageDesc& target);

} // namespace passes
