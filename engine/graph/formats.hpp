// Table of the image formats this renderer uses.
#pragma once
#include <cstdint>
#include <span>
#include <volk.h>

namespace graph {

struct Format
{
    VkFormat format;
    const char* name;            // "RGBA16F"
    std::uint32_t bytes;         // per texel
    int cv_type;                 // type of the cv::Mat that holds it on the CPU
    VkFormatFeatureFlags needed; // features the device must support, optimal tiling
};

std::span<const Format> formats();

/// Null when the format is not in the table.
const Format* find_format(VkFormat format);

bool is_depth(VkFormat format);

} // namespace graph
