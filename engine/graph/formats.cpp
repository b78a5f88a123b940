#include "engine/graph/formats.hpp"

#include <array>
#include <opencv2/core.hpp>

namespace graph {

namespace {

constexpr VkFormatFeatureFlags sampled_use =
    VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
constexpr VkFormatFeatureFlags target_use = VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
constexpr VkFormatFeatureFlags stored_use = VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT;
constexpr VkFormatFeatureFlags depth_use =
    VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;

constexpr std::array<Format, 11> format_table{{
    {VK_FORMAT_R8_UNORM, "R8", 1, CV_8UC1, sampled_use | target_use | stored_use},
    {VK_FORMAT_R8G8_UNORM, "RG8", 2, CV_8UC2, sampled_use | target_use | stored_use},
    {VK_FORMAT_R8G8B8A8_UNORM, "RGBA8", 4, CV_8UC4, sampled_use | target_use | stored_use},
    {VK_FORMAT_R8G8B8A8_SRGB, "RGBA8_SRGB", 4, CV_8UC4, sampled_use},
    {VK_FORMAT_R16_SFLOAT, "R16F", 2, CV_16FC1, sampled_use | target_use | stored_use},
    {VK_FORMAT_R16G16_SFLOAT, "RG16F", 4, CV_16FC2, sampled_use | target_use | stored_use},
    {VK_FORMAT_R16G16B16A16_SFLOAT, "RGBA16F", 8, CV_16FC4, sampled_use | target_use | stored_use},
    {VK_FORMAT_R32_SFLOAT, "R32F", 4, CV_32FC1, sampled_use | target_use | stored_use},
    {VK_FORMAT_R32G32_SFLOAT, "RG32F", 8, CV_32FC2, sampled_use | target_use | stored_use},
    {VK_FORMAT_R32G32B32A32_SFLOAT, "RGBA32F", 16, CV_32FC4, sampled_use | target_use | stored_use},
    {VK_FORMAT_D32_SFLOAT, "D32F", 4, CV_32FC1, depth_use},
}};

} // namespace

std::span<const Format> formats()
{
    return format_table;
}

const Format* find_format(VkFormat format)
{
    for (const Format& entry : format_table)
        if (entry.format == format)
            return &entry;
    return nullptr;
}

bool is_depth(VkFormat format)
{
    return format == VK_FORMAT_D32_SFLOAT;
}

} // namespace graph
