#include "head/occlusion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <opencv2/core/utility.hpp>

namespace head {
namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr float start_offset = 3e-4f; // metres along the normal: clear of the vertex's own triangles

glm::vec3 middle(const auto& triangle)
{
    return triangle.corner + (triangle.edge1 + triangle.edge2) / 3.0f;
}

} // namespace

TriangleTree::TriangleTree(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices)
{
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec3 corner = positions[indices[i]];
        triangles_.push_back(
            {corner, positions[indices[i + 1]] - corner, positions[indices[i + 2]] - corner});
    }
    build(0, static_cast<std::uint32_t>(triangles_.size()));
}

void TriangleTree::build(std::uint32_t first, std::uint32_t count)
{
    const std::size_t at = nodes_.size();
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low), middle_low(low), middle_high(high);
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Triangle& t = triangles_[i];
        for (const glm::vec3& p : {t.corner, t.corner + t.edge1, t.corner + t.edge2}) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        middle_low = glm::min(middle_low, middle(t));
        middle_high = glm::max(middle_high, middle(t));
    }
    nodes_.push_back({low, high, first, count});
    if (count <= leaf_size)
        return;
    const glm::vec3 extent = middle_high - middle_low;
    const int axis = extent.x > extent.y && extent.x > extent.z ? 0 : extent.y > extent.z ? 1 : 2;
    const auto begin = triangles_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count,
                     [&](const Triangle& a, const Triangle& b) { return middle(a)[axis] < middle(b)[axis]; });
    nodes_[at].count = 0;
    build(first, count / 2);
    nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
    build(first + count / 2, count - count / 2);
}

bool TriangleTree::hits(glm::vec3 origin, glm::vec3 direction, float reach) const
{
    const glm::vec3 inverse = 1.0f / direction;
    std::uint32_t open[64] = {0}; // the tree is balanced: depth log2 of the triangles
    for (int top = 1; top > 0;) {
        const std::uint32_t at = open[--top];
        const Node& node = nodes_[at];
        const glm::vec3 a = (node.low - origin) * inverse, b = (node.high - origin) * inverse;
        const glm::vec3 near = glm::min(a, b), far = glm::max(a, b);
        if (std::max({near.x, near.y, near.z, 0.0f}) > std::min({far.x, far.y, far.z, reach}))
            continue;
        if (node.count == 0) {
            open[top++] = node.first;
            open[top++] = at + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) { // Möller & Trumbore 1997
            const Triangle& t = triangles_[i];
            const glm::vec3 p = glm::cross(direction, t.edge2), s = origin - t.corner,
                            q = glm::cross(s, t.edge1);
            const float determinant = glm::dot(t.edge1, p);
            const float u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
            const float distance = glm::dot(t.edge2, q) / determinant;
            if (u >= 0 && v >= 0 && u + v <= 1 && distance > 0 &&
                distance < reach) // false for NaN: a parallel triangle
                return true;
        }
    }
    return false;
}

std::vector<float> ambient_occlusion(const TriangleTree& tree, std::span<const glm::vec3> positions,
                                     std::span<const glm::vec3> normals, int rays, float reach)
{
    // A Fibonacci spiral on the unit disc, lifted to the hemisphere: density proportional to the cosine
    // (Malley's method).
    std::vector<glm::vec3> directions;
    for (int i = 0; i < rays; ++i) {
        const float r2 = (static_cast<float>(i) + 0.5f) / static_cast<float>(rays);
        const float angle = glm::two_pi<float>() * glm::fract(static_cast<float>(i) * 0.61803399f);
        directions.emplace_back(std::sqrt(r2) * std::cos(angle), std::sqrt(r2) * std::sin(angle),
                                std::sqrt(1.0f - r2));
    }
    std::vector<float> open(positions.size());
    cv::parallel_for_(cv::Range(0, static_cast<int>(positions.size())), [&](const cv::Range& range) {
        for (int v = range.start; v < range.end; ++v) {
            const glm::vec3 n = normals[v];
            const glm::vec3 helper = std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
            const glm::vec3 x = glm::normalize(glm::cross(helper, n)), y = glm::cross(n, x);
            const float turn = glm::two_pi<float>() * glm::fract(static_cast<float>(v) * 0.75487767f);
            const glm::vec3 tx = std::cos(turn) * x + std::sin(turn) * y,
                            ty = std::cos(turn) * y - std::sin(turn) * x;
            int free = 0;
            for (const glm::vec3& d : directions)
                free += !tree.hits(positions[v] + start_offset * n, d.x * tx + d.y * ty + d.z * n, reach);
            open[v] = static_cast<float>(free) / static_cast<float>(rays);
        }
    });
    return open;
}

} // namespace head
