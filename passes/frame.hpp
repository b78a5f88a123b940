// The recipe of a frame: which passes there are and what flows between them.
#pragma once
#include <span>
#include <vector>

#include "engine/graph.hpp"
#include "passes/forward.hpp"
#include "passes/head.hpp"
#include "passes/labels.hpp"
#include "passes/reflectance_lut.hpp"
#include "passes/wound_texture.hpp"
#include "wound/wound.hpp"

namespace passes {

/// A wound of the scene: where it is, its day-0 maps, its tissue over the days.
struct SceneWound
{
    Anchor anchor;
    WoundMaps maps;
    LutTissue tissue;
};

/// What a frame shows. Everything is kept by the caller while the frame is declared.
struct FrameInput
{
    const Head& head;
    std::span<const SceneWound> wounds;
    std::span<const wound::WoundDay> today; // one per wound
    std::span<const wound::Light> lights;
    Camera camera;
    Shading shading;
    wound::Rung reflectance = wound::Rung::TwoStream;
    Canvas canvas;
    std::uint32_t samples = 1;
    float exposure = 1;
    bool every_frame = true; // draw the head even when nothing has changed, as those who measure it want
};

struct FrameImages
{
    engine::ImageId picture;  // RGBA8, sRGB-encoded
    engine::ImageId radiance; // RGBA16F, linear, neither exposed nor with a backdrop, premultiplied
    std::vector<WoundTexture> wounds;
    LabelImages labels; // cost nothing unless they are read back
};

FrameImages add_frame(engine::Graph& graph, const FrameInput& input);

} // namespace passes
