// An image uploaded from the CPU, with its mip levels.
//
// sRGB colour stays 8-bit and the sampler decodes it before it filters. On
// llvmpipe a trilinear sample of it costs 1.3 times one of plain RGBA8, but
// decoded once into RGBA16F it would cost 1.45 times and twice the memory.
#pragma once
#include "engine/gpu/memory.hpp"
#include "engine/graph/graph.hpp"

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace gpu {

enum class Encoding : std::uint8_t
{
    Linear, // values as they are: masks, normals, tables, floats
    Srgb,   // 8-bit colour, kept as RGBA8_SRGB; the shader gets linear light, alpha as it is
};

class Texture
{
  public:
    /// 1, 2 or 4 channels of 8-bit, half or float; Srgb: 4
    /// channels of 8-bit. With `mips`, averaged in linear light.
    Texture(const Device& device, const cv::Mat& picture, Encoding encoding, bool mips,
            const std::string& name);

    graph::ExternalImage external() const { return {image_.desc(), image_.view(), content_id_}; }

  private:
    Image image_;
    std::uint64_t content_id_ = 0;
};

/// Half the size each (rounded down, at least 1), down to
/// 1 x 1, box filtered; the first is the picture itself.
std::vector<cv::Mat> mip_chain(const cv::Mat& picture, Encoding encoding);

/// A number never given before in this process, so that new contents are never taken for old ones.
std::uint64_t new_content_id();

} // namespace gpu
