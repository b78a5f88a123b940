// A mesh as read from a file, with vertex data that may be missing, and functions that compute the missing
// data.
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
    std::vector<std::uint8_t> known; // per vertex: bits of Known
    std::vector<std::uint32_t> indices;
    std::vector<Primitive> primitives; // consecutive in `indices`
};

/// Drops zero-area triangles and unused vertices. Returns the number of dropped triangles.
std::size_t drop_degenerate(RawMesh& mesh);

/// Computes missing texture coordinates by projection onto a cylinder about the vertical axis; u exceeds 1
/// across the seam at the back. Returns whether any were missing.
bool complete_uvs(RawMesh& mesh);

/// Computes missing vertex normals, weighted by angle. Vertices at the same position get the same normal, so
/// that texture seams are invisible. Returns whether any were missing.
bool complete_normals(RawMesh& mesh);

/// Computes missing tangents along u as in MikkTSpace (Mikkelsen 2008): angle-weighted over vertices of equal
/// position, normal and uv, separately for mirrored and unmirrored charts (shared vertices are duplicated),
/// orthogonal to the normal. Where the uvs span no area the tangent is horizontal. Returns whether any were
/// missing.
bool complete_tangents(RawMesh& mesh);

} // namespace head
