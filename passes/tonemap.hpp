// The picture as the screen and the file want it: linear light to 8-bit sRGB, encoded by our own shader.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "engine/graph/graph.hpp"
#include "passes/viewport_tile.hpp"

namespace passes {

enum class Highlights : std::uint8_t
{
    SoftShoulder, // below .8 unchanged, above it towards 1 without clipping
    Clip,
};

/// What stands behind the head, where the radiance's alpha is 0: a vertical gradient, linear, not exposed; or
/// nothing.
struct Backdrop
{
    glm::vec3 top{0}, bottom{0}; // of the image
    bool transparent = false;
};
/// The studio's, from the top of the whole picture to its bottom; of a tile, its part of that.
Backdrop backdrop_of(const ViewportTile& tile);

/// Adds one pass. `hdr` is linear Rec. 709, premultiplied by its alpha; the result, of the same size, is
/// RGBA8 UNORM holding sRGB codes: opaque, or with a transparent backdrop straight alpha. `exposure` in
/// stops: each doubles the light. No dither, so that equal frames give equal files.
graph::ImageId add_tonemap(graph::Graph& graph, graph::ImageId hdr, float exposure,
                           Highlights highlights = Highlights::SoftShoulder, const Backdrop& backdrop = {});

} // namespace passes
