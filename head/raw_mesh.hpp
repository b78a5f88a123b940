// A mesh on its way from a file to a Model: what is known of each vertex, and the steps that fill in what is
// not.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "head/model.hpp"

namespace head {

struct RawMesh
{
    enum Known : std::uint8_t
    {
        Normal = 1,
        Tangent = 2,
        Uv = 4
    };
    std::vector<Vertex> vertices;
    std::vector<std::uint8_t> known; // per vertex, bits of Known
    std::vector<std::uint32_t> indices;
    std::vector<Primitive> primitives; // consecutive in `indices`
};

/// Drops triangles without area and vertices that no triangle uses. Returns how many triangles went.
std::size_t drop_degenerate(RawMesh& mesh);

/// Projects onto a cylinder about the vertical axis where no texture coordinates are known; u runs on past 1
/// over the seam at the back. Returns whether anything was missing.
bool complete_uvs(RawMesh& mesh);

/// Angle-weighted vertex normals where none are known. Vertices at the same place share them, so that texture
/// seams do not show. Returns whether anything was missing.
bool complete_normals(RawMesh& mesh);

/// Tangents along u where none are known, in the manner of MikkTSpace (Mikkelsen 2008): angle-weighted over
/// vertices of equal place, normal and uv, apart for mirrored and unmirrored charts (such vertices are
/// doubled), orthogonal to the normal. Where the uvs span no area the tangent is horizontal. Returns whether
/// anything was missing.
bool complete_tangents(RawMesh& mesh);

} // namespace head
