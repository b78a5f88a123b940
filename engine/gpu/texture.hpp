// An image uploaded from the CPU, with its mip levels.
//
// sRGB colour stays 8-bit; the sampler decodes it before filtering. On llvmpipe
// a trilinear sample costs 1.3 times one of linear RGBA8. Colour decoded to
// RGBA16F at upload would cost 1.45 times and need twice the memory.
#pragma once
#include "engine/gpu/memory.hpp"
#include "engine/graph/graph.hpp"

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace gpu {

enum class Encoding : std::uint8_t
{
    Linear, // values are not converted: masks, normals, tables, floats
    Srgb,   // 8-bit colour, stored as RGBA8_SRGB; the shader reads linear RGB, alpha unchanged
};

class Texture
{
  public:
    /// 1, 2 or 4 channels of 8-bit, half or float; Srgb: 4 channels
    /// of 8-bit. `mips` adds mip levels, averaged in linear light.
    Texture(const Device& device, const cv::Mat& picture, Encoding encoding, bool mips,
            const std::string& name);

    graph::ExternalImage external() const { return {image_.desc(), image_.view(), content_id_}; }

  private:
    Image image_;
    std::uint64_t content_id_ = 0;
};

/// The picture, then box-filtered levels of half the
/// size (rounded down, at least 1) down to 1 x 1.
std::vector<cv::Mat> mip_chain(const cv::Mat& picture, Encoding encoding);

/// A number unique in this process, which distinguishes new contents from old ones.
std::uint64_t new_content_id();

} // namespace gpu
