// The shape of the default head: which faces of the refined figure belong to the bust, and where it is cut.
#pragma once
#include <array>
#include <vector>

#include "tools/head/quad_mesh.hpp"

namespace head_tool {

/// Triangles with texture coordinates of their own at every corner; lengths and coordinates as in MakeHuman's
/// figure.
struct CutMesh
{
    struct Corner
    {
        std::uint32_t vertex, uv;
    };
    using Triangle = std::array<Corner, 3>;
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec2> uvs;
    std::vector<Triangle> head, torso, inner; // by texture chart; inner: mouth bag and eye sockets
};

/// Refines the upper part of the figure's skin and cuts off what lies below the bust's base.
CutMesh cut_bust(const QuadMesh& body);

/// A mesh as triangles, uncut: all in `head`.
CutMesh as_triangles(const QuadMesh& mesh);

} // namespace head_tool
