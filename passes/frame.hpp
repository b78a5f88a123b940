// Declares a frame: its passes and the images that they exchange.
#pragma once
#include <span>
#include <vector>

#include "engine/graph/graph.hpp"
#include "passes/forward.hpp"
#include "passes/head.hpp"
#include "passes/labels.hpp"
#include "passes/reflectance_lut.hpp"
#include "passes/skin.hpp"
#include "passes/wound_texture.hpp"
#include "wound/optics/transport.hpp"
#include "wound/wound.hpp"

namespace passes {

/// A wound in a frame: its position, day-0 maps, tissue over the days, and today's state.
struct FrameWound
{
    const head::Anchor& anchor;
    const WoundMaps& maps;
    const LutTissue& tissue; // wounds that share it share its table
    const wound::WoundDay& today;
    const PackedWarps& warps; // of today
};

/// The contents of a frame. The caller must keep everything alive during add_frame().
struct FrameInput
{
    const Head& head;
    std::span<const FrameWound> wounds; // at most shared::MAX_WOUNDS; of the head's anchors, in their order
    std::span<const optics::Light> lights; // at most shared::MAX_LIGHTS
    head::Camera camera;
    optics::Shading shading;
    optics::ReflectanceModel reflectance = optics::ReflectanceModel::TwoStream;
    ViewportTile tile;
    std::uint32_t samples = 1;
    float exposure_stops = 0;    // each stop doubles the light
    bool every_frame = true;     // draw the head even when nothing has changed, for measurements
    optics::TissueSpread tissue; // of the skin
    const Skin* skin = nullptr;  // of `head` and its wounds, for what follows
    /// Light is kept on the skin where that can be done, for frames between which it stands: scale of the
    /// atlas, atlas_scale(). None: light is computed in every pixel.
    std::optional<double> kept_scale;
    /// For transport `diffused`: scale of the atlas on which light spreads, diffusion_scale(). None: it is
    /// drawn as `preintegrated`, which needs no time when the lights change.
    std::optional<double> diffusion_scale;
    bool radiance = true; // FrameImages::radiance is needed
};

struct FrameImages
{
    graph::ImageId picture; // RGBA8, sRGB-encoded
    graph::ImageId
        radiance; // RGBA16F, linear, premultiplied, without exposure and backdrop; of FrameInput::radiance
    std::vector<WoundTexture> wounds;
    LabelImages labels; // drawn only if they are read back
};

/// What cannot be seen costs nothing: lights without strength, terms without a coefficient, and wounds that
/// the tile does not show are left out of the picture's passes.
FrameImages add_frame(graph::Graph& graph, const FrameInput& input);

} // namespace passes
