// Converts values at a mesh's vertices to pictures in its texture space.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <span>

namespace head_tool {

/// Rasterises triangles in texture space (uv 0..1, v down): interpolates the corner values at each texel with
/// its centre in a triangle. `covered` is 255 at these texels, else 0.
cv::Mat3f rasterise(std::span<const glm::vec2> uvs, std::span<const std::uint32_t> indices,
                    std::span<const glm::vec3> values, cv::Size size, cv::Mat1b& covered);

/// Fills the uncovered texels smoothly from their surroundings, so that no seam is visible at any mip level
/// (push-pull, Gortler et al. 1996).
void fill_uncovered(cv::Mat3f& texture, const cv::Mat1b& covered);

} // namespace head_tool
