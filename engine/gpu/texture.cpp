#include "engine/gpu/texture.hpp"

#include "base/sampling.hpp"
#include "engine/gpu/device.hpp"
#include "engine/gpu/vulkan_check.hpp"
#include "engine/graph/formats.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <stdexcept>

namespace gpu {

namespace {

VkFormat texture_format(const cv::Mat& picture, Encoding encoding)
{
    if (encoding == Encoding::Srgb)
        return picture.type() == CV_8UC4 ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_UNDEFINED;
    for (const graph::Format& format : graph::formats())
        if (format.cv_type == picture.type() && !graph::is_depth(format.format))
            return format.format; // the table lists the linear format before the sRGB one
    return VK_FORMAT_UNDEFINED;
}

float srgb_to_linear(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float linear_to_srgb(float linear)
{
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// Linear light, 0..255, by 8-bit sRGB code.
const std::array<float, 256>& linear_of_code()
{
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = 255.0f * srgb_to_linear(static_cast<float>(i) / 255.0f);
        return values;
    }();
    return table;
}

/// Converts to float, sRGB colour to linear light; values of 8-bit pictures keep the range 0..255.
cv::Mat to_linear_float(const cv::Mat& picture, Encoding encoding)
{
    cv::Mat linear;
    picture.convertTo(linear, CV_32F);
    if (encoding == Encoding::Linear)
        return linear;
    const std::array<float, 256>& table = linear_of_code();
    linear.forEach<cv::Vec4f>([&table](cv::Vec4f& texel, const int*) {
        for (int c = 0; c < 3; ++c)
            texel[c] = table[static_cast<std::size_t>(texel[c])];
    });
    return linear;
}

/// First mip level of an 8-bit picture of even size, directly from its bytes: writing a large picture as
/// floats would take longer than computing all levels below it.
cv::Mat half_from_bytes(const cv::Mat& picture, Encoding encoding)
{
    const int channels = picture.channels();
    cv::Mat half(picture.rows / 2, picture.cols / 2, CV_MAKETYPE(CV_32F, channels));
    const std::array<float, 256>& table = linear_of_code();
    cv::parallel_for_(cv::Range(0, half.rows), [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y) {
            const uchar *upper = picture.ptr(2 * y), *lower = picture.ptr(2 * y + 1);
            float* to = half.ptr<float>(y);
            for (int i = 0; i < half.cols * channels; ++i) {
                const int c = i % channels, at = i / channels * 2 * channels + c;
                const uchar four[] = {upper[at], upper[at + channels], lower[at], lower[at + channels]};
                float sum = 0;
                for (const uchar code : four)
                    sum += encoding == Encoding::Srgb && c < 3 ? table[code] : float(code);
                to[i] = sum / 4;
            }
        }
    });
    return half;
}

cv::Mat from_linear_float(const cv::Mat& linear, int type, Encoding encoding)
{
    cv::Mat encoded = linear;
    if (encoding == Encoding::Srgb) {
        encoded = linear.clone();
        encoded.forEach<cv::Vec4f>([](cv::Vec4f& texel, const int*) {
            for (int c = 0; c < 3; ++c)
                texel[c] = 255.0f * linear_to_srgb(texel[c] / 255.0f);
        });
    }
    cv::Mat result;
    encoded.convertTo(result, type);
    return result;
}

void copy_levels(VkCommandBuffer commands, const Buffer& staging, const Image& image,
                 const std::vector<cv::Mat>& levels)
{
    graph::AccessState state;
    const auto move_to = [&](graph::Usage usage) {
        const VkImageMemoryBarrier2 image_barrier =
            graph::vulkan_barrier(*graph::advance(state, usage), image.handle(), image.range());
        const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                          .imageMemoryBarrierCount = 1,
                                          .pImageMemoryBarriers = &image_barrier};
        vkCmdPipelineBarrier2(commands, &dependency);
    };
    move_to(graph::Usage::CopyDestination);
    std::vector<VkBufferImageCopy> regions;
    VkDeviceSize offset = 0;
    for (std::uint32_t level = 0; level < levels.size(); ++level) {
        const cv::Mat& picture = levels[level];
        regions.push_back({.bufferOffset = offset,
                           .imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT,
                                                .mipLevel = level,
                                                .layerCount = 1},
                           .imageExtent = {static_cast<std::uint32_t>(picture.cols),
                                           static_cast<std::uint32_t>(picture.rows), 1}});
        offset += (picture.total() * picture.elemSize() + 15) / 16 * 16;
    }
    vkCmdCopyBufferToImage(commands, staging.handle(), image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           static_cast<std::uint32_t>(regions.size()), regions.data());
    move_to(graph::Usage::SampledInCompute); // from here on all shader stages may read, and nothing
                                             // writes again
    move_to(graph::Usage::SampledInRaster);
}

} // namespace

Texture::Texture(const Device& device, const cv::Mat& picture, Encoding encoding, bool mips,
                 const std::string& name)
    : content_id_(new_content_id())
{
    const VkFormat format = texture_format(picture, encoding);
    if (picture.empty() || format == VK_FORMAT_UNDEFINED)
        throw std::logic_error(
            fmt::format("texture {}: its pixel type {} cannot be uploaded", name, picture.type()));
    const std::vector<cv::Mat> levels = mips ? mip_chain(picture, encoding) : std::vector<cv::Mat>{picture};
    const graph::ImageDesc desc{static_cast<std::uint32_t>(picture.cols),
                                static_cast<std::uint32_t>(picture.rows), format};
    image_ = Image(device, desc, static_cast<std::uint32_t>(levels.size()),
                   VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, name);

    // Each level starts on a multiple of 16, which suits every texel size.
    std::size_t size = 0;
    for (const cv::Mat& level : levels)
        size += (level.total() * level.elemSize() + 15) / 16 * 16;
    const Buffer staging(device, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::Write,
                         name + " staging");
    std::byte* to = staging.mapped().data();
    for (const cv::Mat& level : levels) {
        const std::size_t row = static_cast<std::size_t>(level.cols) * level.elemSize();
        for (int y = 0; y < level.rows; ++y)
            std::memcpy(to + static_cast<std::size_t>(y) * row, level.ptr(y), row);
        to += (level.total() * level.elemSize() + 15) / 16 * 16;
    }
    device.run_once([&](VkCommandBuffer commands) { copy_levels(commands, staging, image_, levels); });
}

std::vector<cv::Mat> mip_chain(const cv::Mat& picture, Encoding encoding)
{
    std::vector<cv::Mat> levels{picture};
    cv::Mat linear;
    if (picture.depth() == CV_8U && picture.cols % 2 == 0 && picture.rows % 2 == 0) {
        linear = half_from_bytes(picture, encoding);
        levels.push_back(from_linear_float(linear, picture.type(), encoding));
    } else
        linear = to_linear_float(picture, encoding);
    const std::vector<cv::Mat> halved = base::mip_levels(linear);
    for (std::size_t i = 1; i < halved.size(); ++i)
        levels.push_back(from_linear_float(halved[i], picture.type(), encoding));
    return levels;
}

std::uint64_t new_content_id()
{
    static std::atomic<std::uint64_t> next{1};
    return next++;
}

} // namespace gpu
