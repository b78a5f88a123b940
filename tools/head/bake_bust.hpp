// Shape of the default head: selects the figure's faces of the bust, refines them and cuts the base.
#pragma once
#include <array>
#include <vector>

#include "tools/head/quad_mesh.hpp"

namespace head_tool {

/// Triangles with separate texture coordinates at every corner; units and axes as in MakeHuman's figure.
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

/// Refines the upper part of the figure's skin and removes everything below the bust's base.
CutMesh cut_bust(const QuadMesh& body);

/// The mesh as triangles, uncut; all are in `head`.
CutMesh as_triangles(const QuadMesh& mesh);

} // namespace head_tool
