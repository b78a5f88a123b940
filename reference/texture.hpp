// A material's pictures as the rasteriser's sampler reads them: repeated, bilinear, sRGB decoded before it is
// filtered. Without mip levels: many samples per pixel filter better.
#pragma once
#include <glm/glm.hpp>
#include <opencv2/core.hpp>

namespace reference {

/// rgb linear reflectance and alpha; white when there is no picture. 0..1.
glm::dvec4 sample_srgb(const cv::Mat4b& picture, const glm::dvec2& uv);
/// The same without decoding, three channels. The picture must not be empty.
glm::dvec3 sample_linear(const cv::Mat3b& picture, const glm::dvec2& uv);

} // namespace reference
