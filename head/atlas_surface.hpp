// What of the head lies where on its atlas, and what lies beyond the borders of its charts: for light that
// spreads over the skin, whatever the texture coordinates do.
//
// A skirt is a strip outside a border edge. It continues the chart with the triangle across the seam, laid
// flat into the plane of the atlas by the similarity that joins the edge's two images.
#pragma once
#include <span>
#include <vector>

#include "head/atlas.hpp"

namespace head {

/// Where the outer edge of a skirt of width 1 is mitred at a border vertex. `across`: sum of the unit vectors
/// away from the chart, across the border edges that meet there.
glm::vec2 mitred(const glm::vec2& across);

/// A vertex of a skirt moves with the skirt's width w, units: w times what is called outward is added.
struct SurfaceVertex
{
    glm::vec2 at{0.0f}, at_outward{0.0f};             // units
    glm::vec2 from{0.0f}, from_outward{0.0f};         // units: where the same skin lies in a chart
    glm::vec3 position{0.0f}, position_outward{0.0f}; // m
};

/// Of one tile.
struct SurfacePiece
{
    glm::uvec2 corner{0}, size{0};                            // units, of the tile
    std::uint32_t first_index = 0, skirts = 0, triangles = 0; // numbers of indices: the skirts come first
};

struct AtlasSurface
{
    std::vector<SurfaceVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<SurfacePiece> pieces; // one per tile with home triangles
};

/// The margins and home triangles of these tiles, in the order in which they are to be drawn. `skirts`: with
/// skirts around the charts of the home triangles; a border that no other home triangle shares continues
/// flat, with the skin of the border.
AtlasSurface surface_of(const Model& model, std::span<const AtlasTile> tiles, bool skirts);

} // namespace head
