#include "head/occlusion.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <opencv2/core/utility.hpp>

namespace head {
namespace {

constexpr float start_offset = 3e-4f; // metres along the normal, to avoid hitting the vertex's own triangles

} // namespace

std::vector<float> ambient_occlusion(const Bvh& bvh, std::span<const glm::vec3> positions,
                                     std::span<const glm::vec3> normals, int rays, float reach)
{
    // A Fibonacci spiral on the unit disc, projected to the hemisphere: density proportional to the cosine
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
            const glm::dvec3 start(positions[v] + start_offset * n);
            int free = 0;
            for (const glm::vec3& d : directions)
                free += !bvh.any(start, glm::dvec3(d.x * tx + d.y * ty + d.z * n), reach);
            open[v] = static_cast<float>(free) / static_cast<float>(rays);
        }
    });
    return open;
}

} // namespace head
