// The picture as the screen and the file want it: linear light to 8-bit sRGB, encoded by our own shader.
#pragma once
#include <cstdint>

#include "engine/graph.hpp"

namespace passes {

enum class Highlights : std::uint8_t
{
    SoftShoulder, // below .8 unchanged, above it towards 1 without clipping
    Clip,
};

/// Adds one pass. `hdr` is linear Rec. 709; the result, of the same size, is RGBA8 UNORM holding sRGB codes,
/// opaque. `exposure` in stops: each doubles the light. No dither, so that equal frames give equal files.
engine::ImageId add_tonemap(engine::Graph& graph, engine::ImageId hdr, float exposure,
                            Highlights highlights = Highlights::SoftShoulder);

} // namespace passes
