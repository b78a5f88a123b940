#include "head/albedo_under.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/color.hpp"
#include "base/smoothstep.hpp"

namespace head {
namespace {

constexpr double reach = Anchor::reach;

/// A triangle of skin; `at` holds its corners in the anchor's frame.
struct PatchTriangle
{
    std::array<const Vertex*, 3> corners;
    std::array<glm::dvec3, 3> at;
};

double cross_2d(const glm::dvec3& a, const glm::dvec3& b)
{
    return a.x * b.y - a.y * b.x;
}

/// Calls visit(row, column, height, weights) for every texel whose centre projects into the triangle, if the
/// triangle lies within reach there.
template <typename Visit>
void visit_texels(const PatchTriangle& triangle, double area, int size, const Visit& visit)
{
    const auto& q = triangle.at;
    const auto texel = [&](double t) { return (t + 1) * 0.5 * size - 0.5; };
    const int x0 = std::max(0, int(std::ceil(texel(std::min({q[0].x, q[1].x, q[2].x})))));
    const int x1 = std::min(size - 1, int(std::floor(texel(std::max({q[0].x, q[1].x, q[2].x})))));
    const int y0 = std::max(0, int(std::ceil(texel(std::min({q[0].y, q[1].y, q[2].y})))));
    const int y1 = std::min(size - 1, int(std::floor(texel(std::max({q[0].y, q[1].y, q[2].y})))));
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            // Slightly off the centre: on a regular mesh a centre could lie on the edge of two
            // triangles.
            const glm::dvec3 p((x + 0.5) * 2 / size - 1 + 1.3e-9, (y + 0.5) * 2 / size - 1 + 2.9e-9, 0);
            const double b = cross_2d(p - q[0], q[2] - q[0]) / area,
                         c = cross_2d(q[1] - q[0], p - q[0]) / area;
            const double height = q[0].z + b * (q[1].z - q[0].z) + c * (q[2].z - q[0].z);
            if (b >= 0 && c >= 0 && b + c <= 1 && std::abs(height) <= reach)
                visit(y, x, height, glm::dvec3(1 - b - c, b, c));
        }
}

/// Calls visit(triangle, row, column, height, weights) for every texel centre and every skin triangle there
/// that faces the patch's viewer.
template <typename Visit>
void visit_skin(const Model& head, std::uint32_t material, const Anchor& anchor, int size, const Visit& visit)
{
    for (const Primitive& primitive : head.primitives) {
        if (primitive.material != material)
            continue;
        for (std::size_t i = primitive.first_index;
             i + 2 < std::size_t(primitive.first_index) + primitive.index_count; i += 3)
        {
            PatchTriangle triangle;
            std::array<glm::vec3, 3> corners;
            for (std::size_t k = 0; k < 3; ++k) {
                triangle.corners[k] = &head.vertices[head.indices[i + k]];
                corners[k] = triangle.corners[k]->position;
                triangle.at[k] = in_frame(anchor, glm::dvec3(corners[k]));
            }
            if (!receives(anchor, corners))
                continue;
            const double area = cross_2d(triangle.at[1] - triangle.at[0], triangle.at[2] - triangle.at[0]);
            if (area < -1e-12) // v points down: triangles that face the viewer are clockwise in (u, v)
                visit_texels(triangle, area, size,
                             [&](int y, int x, double height, const glm::dvec3& weights) {
                                 visit(triangle, y, x, height, weights);
                             });
        }
    }
}

cv::Vec3f linear_albedo(const Material& material, const glm::dvec2& uv)
{
    const glm::vec4 factor = material.base_color_factor;
    if (material.base_color.empty())
        return {factor.x, factor.y, factor.z};
    const auto wrap = [](double t, int n) {
        return std::clamp(int(std::floor((t - std::floor(t)) * n)), 0, n - 1);
    };
    const cv::Vec4b texel =
        material.base_color(wrap(uv.y, material.base_color.rows), wrap(uv.x, material.base_color.cols));
    const auto linear = [&](int channel) { return base::srgb_to_linear(texel[channel] / 255.0f); };
    return {linear(0) * factor.x, linear(1) * factor.y, linear(2) * factor.z};
}

} // namespace

cv::Mat3f albedo_under(const Model& head, std::uint32_t material, const Anchor& anchor, int size)
{
    cv::Mat3f skin(size, size, cv::Vec3f::all(std::numeric_limits<float>::quiet_NaN()));
    cv::Mat1d highest(size, size, -reach);
    visit_skin(head, material, anchor, size,
               [&](const PatchTriangle& triangle, int y, int x, double height, const glm::dvec3& weights) {
                   if (height <= highest(y, x))
                       return;
                   highest(y, x) = height;
                   glm::dvec2 uv(0);
                   for (int k = 0; k < 3; ++k)
                       uv += weights[k] * glm::dvec2(triangle.corners[std::size_t(k)]->uv);
                   skin(y, x) = linear_albedo(head.materials[material], uv);
               });
    return skin;
}

cv::Mat1f surface_under(const Model& head, std::uint32_t material, const Anchor& anchor, int size)
{
    const double texel_mm = 2e3 * anchor.half_width_m / size;
    cv::Mat1f surface = cv::Mat1f::zeros(size, size);
    visit_skin(head, material, anchor, size,
               [&](const PatchTriangle& triangle, int y, int x, double height, const glm::dvec3& weights) {
                   const auto& q = triangle.at;
                   const glm::dvec3 flat = glm::normalize(glm::cross(q[2] - q[0], q[1] - q[0]));
                   glm::dvec3 normal(0);
                   for (int k = 0; k < 3; ++k)
                       normal += weights[k] * glm::dvec3(triangle.corners[std::size_t(k)]->normal);
                   const double cosine =
                       glm::dot(normal, anchor.normal) / std::max(glm::length(normal), 1e-9);
                   // The area depends on the triangle's slope, the received share on the smooth normal.
                   surface(y, x) += float(share_received(cosine, height) * texel_mm * texel_mm /
                                          std::max(std::abs(flat.z), 1e-3));
               });
    return surface;
}

double share_received(double cosine, double height)
{
    return base::smoothstep(0.15, 0.45, cosine) * (1 - base::smoothstep(0.8, 1.0, std::abs(height) / reach));
}

} // namespace head
