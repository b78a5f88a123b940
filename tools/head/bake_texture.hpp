// From values at a mesh's vertices to pictures in its texture space.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <span>

namespace head_tool {

/// Draws triangles over the texture (uv 0..1, v down): each texel whose centre a triangle covers gets the
/// interpolated values of its corners. `covered` becomes 255 there.
cv::Mat3f rasterise(std::span<const glm::vec2> uvs, std::span<const std::uint32_t> indices,
                    std::span<const glm::vec3> values, cv::Size size, cv::Mat1b& covered);

/// Gives the texels that nothing covers smooth values from those around, so that seams show at no mip level
/// (push-pull, Gortler et al. 1996).
void fill_uncovered(cv::Mat3f& texture, const cv::Mat1b& covered);

} // namespace head_tool
