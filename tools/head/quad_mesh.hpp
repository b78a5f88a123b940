// A mesh of quads with separate texture coordinates at every corner, and its subdivision.
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

/// One step of Catmull & Clark 1978 on the positions. Open edges become B-spline curves; texture coordinates
/// are interpolated linearly. Face f becomes faces 4f .. 4f+3, one at each of its corners.
QuadMesh subdivide(const QuadMesh& mesh);

/// Number of each face's texture chart. Faces connected by shared texture coordinates form a chart.
std::vector<std::uint32_t> texture_charts(const QuadMesh& mesh);

} // namespace head_tool
