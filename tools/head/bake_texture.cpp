#include "tools/head/bake_texture.hpp"

#include <algorithm>
#include <cmath>

namespace head_tool {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/// Halves the size of a picture; each texel is the weighted mean of up to four texels.
void push(const cv::Mat3f& fine, const cv::Mat1f& fine_weight, cv::Mat3f& coarse, cv::Mat1f& coarse_weight)
{
    coarse = cv::Mat3f((fine.rows + 1) / 2, (fine.cols + 1) / 2, cv::Vec3f(0, 0, 0));
    coarse_weight = cv::Mat1f(coarse.size(), 0.0f);
    for (int y = 0; y < fine.rows; ++y)
        for (int x = 0; x < fine.cols; ++x) {
            coarse(y / 2, x / 2) += fine_weight(y, x) * fine(y, x);
            coarse_weight(y / 2, x / 2) += fine_weight(y, x);
        }
    for (int y = 0; y < coarse.rows; ++y)
        for (int x = 0; x < coarse.cols; ++x) {
            if (coarse_weight(y, x) > 0)
                coarse(y, x) /= coarse_weight(y, x);
            coarse_weight(y, x) = std::min(coarse_weight(y, x), 1.0f);
        }
}

cv::Vec3f bilinear(const cv::Mat3f& picture, float x, float y)
{
    const int x0 = std::clamp(static_cast<int>(std::floor(x)), 0, picture.cols - 1),
              x1 = std::min(x0 + 1, picture.cols - 1);
    const int y0 = std::clamp(static_cast<int>(std::floor(y)), 0, picture.rows - 1),
              y1 = std::min(y0 + 1, picture.rows - 1);
    const float fx = std::clamp(x - static_cast<float>(x0), 0.0f, 1.0f),
                fy = std::clamp(y - static_cast<float>(y0), 0.0f, 1.0f);
    return (1 - fy) * ((1 - fx) * picture(y0, x0) + fx * picture(y0, x1)) +
           fy * ((1 - fx) * picture(y1, x0) + fx * picture(y1, x1));
}

void push_pull(cv::Mat3f& texture, const cv::Mat1f& weight)
{
    if (texture.total() <= 1)
        return;
    cv::Mat3f coarse;
    cv::Mat1f coarse_weight;
    push(texture, weight, coarse, coarse_weight);
    push_pull(coarse, coarse_weight);
    for (int y = 0; y < texture.rows; ++y)
        for (int x = 0; x < texture.cols; ++x)
            if (const float w = weight(y, x); w < 1)
                texture(y, x) =
                    w * texture(y, x) + (1 - w) * bilinear(coarse, 0.5f * static_cast<float>(x) - 0.25f,
                                                           0.5f * static_cast<float>(y) - 0.25f);
}

} // namespace

cv::Mat3f rasterise(std::span<const glm::vec2> uvs, std::span<const std::uint32_t> indices,
                    std::span<const glm::vec3> values, cv::Size size, cv::Mat1b& covered)
{
    cv::Mat3f texture(size, cv::Vec3f(0, 0, 0));
    covered = cv::Mat1b(size, uchar(0));
    const glm::dvec2 scale(size.width, size.height);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        glm::dvec2 p[3];
        for (int c = 0; c < 3; ++c)
            p[c] = glm::dvec2(uvs[indices[i + c]]) * scale - 0.5; // texel centres at integers
        const double area = cross(p[1] - p[0], p[2] - p[0]);
        if (area == 0)
            continue;
        const glm::dvec2 low = glm::min(p[0], glm::min(p[1], p[2])),
                         high = glm::max(p[0], glm::max(p[1], p[2]));
        for (int y = std::max(0, static_cast<int>(std::ceil(low.y)));
             y <= std::min(size.height - 1.0, high.y); ++y)
            for (int x = std::max(0, static_cast<int>(std::ceil(low.x)));
                 x <= std::min(size.width - 1.0, high.x); ++x) {
                const glm::dvec2 at(x, y);
                const double a = cross(p[1] - at, p[2] - at) / area, b = cross(p[2] - at, p[0] - at) / area;
                constexpr double edge = -1e-9; // a texel on a shared edge belongs to both triangles
                if (a < edge || b < edge || 1 - a - b < edge)
                    continue;
                const glm::dvec3 value = a * glm::dvec3(values[indices[i]]) +
                                         b * glm::dvec3(values[indices[i + 1]]) +
                                         (1 - a - b) * glm::dvec3(values[indices[i + 2]]);
                texture(y, x) = cv::Vec3f(static_cast<float>(value.x), static_cast<float>(value.y),
                                          static_cast<float>(value.z));
                covered(y, x) = 255;
            }
    }
    return texture;
}

void fill_uncovered(cv::Mat3f& texture, const cv::Mat1b& covered)
{
    cv::Mat1f weight;
    covered.convertTo(weight, CV_32F, 1.0 / 255);
    push_pull(texture, weight);
}

} // namespace head_tool
