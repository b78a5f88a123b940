// Ambient occlusion of a still mesh: what share of the sky each vertex sees.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace head {

/// Triangles sorted into a tree of boxes (median split), to ask whether a ray hits any.
class TriangleTree
{
  public:
    /// Three indices a triangle.
    TriangleTree(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);
    /// Whether anything lies within `reach` of `origin` along the unit vector `direction`, seen from either
    /// side.
    bool hits(glm::vec3 origin, glm::vec3 direction, float reach) const;

  private:
    struct Node
    {
        glm::vec3 low, high;
        std::uint32_t first = 0,
                      count = 0; // triangles of a leaf; count 0: the children are the next node and `first`
    };
    struct Triangle
    {
        glm::vec3 corner, edge1, edge2;
    };
    void build(std::uint32_t first, std::uint32_t count);

    std::vector<Node> nodes_;
    std::vector<Triangle> triangles_;
};

/// Per point, the cosine-weighted share of its hemisphere that is open up to `reach`: 0 enclosed .. 1 open.
/// The same `rays` stratified directions everywhere, turned by a different angle at each point;
/// deterministic.
std::vector<float> ambient_occlusion(const TriangleTree& tree, std::span<const glm::vec3> positions,
                                     std::span<const glm::vec3> normals, int rays, float reach);

} // namespace head
