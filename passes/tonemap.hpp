// Converts linear light to 8-bit sRGB in a shader.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "engine/graph/graph.hpp"
#include "passes/viewport_tile.hpp"

namespace passes {

enum class Highlights : std::uint8_t
{
    SoftShoulder, // unchanged below .8, above it approaches 1 without clipping
    Clip,
};

/// The background where the radiance's alpha is below 1: a vertical gradient, linear, not exposed; or
/// transparent.
struct Backdrop
{
    glm::vec3 top{0}, bottom{0}; // of the image
    bool transparent = false;
};
/// The part of the studio's backdrop, a gradient over the whole picture's height, that the tile covers.
Backdrop backdrop_of(const ViewportTile& tile);

/// Adds one pass. `hdr`: linear Rec. 709, premultiplied by alpha. The result has the same size, RGBA8 UNORM
/// with sRGB codes: opaque, or with straight alpha for a transparent backdrop. `exposure` in stops: each
/// doubles the light. No dither, so that equal frames give equal files.
graph::ImageId add_tonemap(graph::Graph& graph, graph::ImageId hdr, float exposure,
                           Highlights highlights = Highlights::SoftShoulder, const Backdrop& backdrop = {});

} // namespace passes
