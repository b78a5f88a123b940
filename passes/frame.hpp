// The recipe of a frame: which passes there are and what flows between them.
#pragma once
#include <span>
#include <vector>

#include "engine/graph/graph.hpp"
#include "passes/forward.hpp"
#include "passes/head.hpp"
#include "passes/labels.hpp"
#include "passes/reflectance_lut.hpp"
#include "passes/wound_texture.hpp"
#include "wound/wound.hpp"

namespace passes {

/// A wound in a frame: where it is, its day-0 maps, its tissue over the days, and what it is today.
struct FrameWound
{
    const head::Anchor& anchor;
    const WoundMaps& maps;
    const LutTissue& tissue;
    const wound::WoundDay& today;
};

/// What a frame shows. Everything is kept by the caller while the frame is declared.
struct FrameInput
{
    const Head& head;
    std::span<const FrameWound> wounds;    // at most shared::MAX_WOUNDS
    std::span<const optics::Light> lights; // at most shared::MAX_LIGHTS
    head::Camera camera;
    optics::Shading shading;
    optics::ReflectanceModel reflectance = optics::ReflectanceModel::TwoStream;
    ViewportTile tile;
    std::uint32_t samples = 1;
    float exposure_stops = 0; // each doubles the light
    bool every_frame = true;  // draw the head even when nothing has changed, as those who measure it want
};

struct FrameImages
{
    graph::ImageId picture;  // RGBA8, sRGB-encoded
    graph::ImageId radiance; // RGBA16F, linear, neither exposed nor with a backdrop, premultiplied
    std::vector<WoundTexture> wounds;
    LabelImages labels; // cost nothing unless they are read back
};

FrameImages add_frame(graph::Graph& graph, const FrameInput& input);

} // namespace passes
