// A mesh of four-cornered faces with texture coordinates of its own at every corner, and its refinement.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace head_tool {

struct QuadMesh
{
    struct Face
    {
        std::array<std::uint32_t, 4> vertex; // counter-clockwise seen from outside
        std::array<std::uint32_t, 4> uv;
    };
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec2> uvs;
    std::vector<Face> faces;
};

/// One step of Catmull & Clark 1978 on the positions; open edges stay curves of their own, texture
/// coordinates are interpolated linearly. Face f becomes faces 4f .. 4f+3, one at each of its corners.
QuadMesh subdivide(const QuadMesh& mesh);

/// Numbers each face by its texture chart: the faces connected through shared texture coordinates.
std::vector<std::uint32_t> texture_charts(const QuadMesh& mesh);

} // namespace head_tool
