#include "engine/gpu/memory.hpp"

#include "base/input_error.hpp"
#include "engine/gpu/device.hpp"
#include "engine/gpu/vulkan_check.hpp"
#include "engine/graph/formats.hpp"

#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace gpu {

namespace {

VkDeviceMemory allocate(const Device& device, const VkMemoryRequirements& needs, std::uint32_t type)
{
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .allocationSize = needs.size,
                                    .memoryTypeIndex = type};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device.handle(), &info, nullptr, &memory),
          fmt::format("allocate {} bytes", needs.size));
    return memory;
}

std::uint32_t buffer_memory_type(const Device& device, std::uint32_t types, HostAccess host)
{
    constexpr VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
    constexpr VkMemoryPropertyFlags coherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    switch (host) {
    case HostAccess::Write:
        return device.memory_type(types, {visible | coherent}); // Vulkan guarantees it
    case HostAccess::Read:
        return device.memory_type(types, {visible | cached | coherent, visible | cached, visible});
    case HostAccess::None:
        break;
    }
    return device.memory_type(types, {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0});
}

/// True for images used only as attachments: a tile-based GPU needs no memory for them.
bool transient(VkImageUsageFlags usage)
{
    constexpr VkImageUsageFlags attachments =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return (usage & attachments) != 0 && (usage & ~attachments) == 0;
}

} // namespace

// ---- Buffer

Buffer::Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, HostAccess host,
               const std::string& name)
    : Buffer() // delegates, so that the destructor runs after an exception
{
    owner_ = &device;
    bytes_ = size;
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
    check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_), fmt::format("create buffer {}", name));
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device.handle(), buffer_, &needs);
    const std::uint32_t type = buffer_memory_type(device, needs.memoryTypeBits, host);
    coherent_ = device.memory_flags(type) & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    memory_ = allocate(device, needs, type);
    check(vkBindBufferMemory(device.handle(), buffer_, memory_, 0), fmt::format("bind buffer {}", name));
    if (host != HostAccess::None)
        check(vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &pointer_),
              fmt::format("map buffer {}", name));
    device.name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer_), name);
}

Buffer::~Buffer()
{
    if (!owner_)
        return;
    vkDestroyBuffer(owner_->handle(), buffer_, nullptr);
    vkFreeMemory(owner_->handle(), memory_, nullptr);
}

Buffer::Buffer(Buffer&& other) noexcept
{
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept
{
    std::swap(owner_, other.owner_);
    std::swap(buffer_, other.buffer_);
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
    std::swap(pointer_, other.pointer_);
    std::swap(coherent_, other.coherent_);
    return *this;
}

void Buffer::invalidate() const
{
    if (coherent_)
        return;
    // The whole allocation needs no rounding to nonCoherentAtomSize.
    const VkMappedMemoryRange range{.sType = VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE,
                                    .memory = memory_,
                                    .offset = 0,
                                    .size = VK_WHOLE_SIZE};
    check(vkInvalidateMappedMemoryRanges(owner_->handle(), 1, &range), "read back a buffer");
}

// ---- Image

Image::Image(const Device& device, const graph::ImageDesc& desc, std::uint32_t mip_levels,
             VkImageUsageFlags usage,
             const std::string& name)
    : Image() // delegates, so that the destructor runs after an exception
{
    owner_ = &device;
    desc_ = desc;
    levels_ = mip_levels;
    usage_ = usage;
    const std::uint32_t limit = device.limits().maxImageDimension2D;
    if (desc.width > limit || desc.height > limit)
        throw base::InputError(fmt::format("image {}", name),
                               fmt::format("{} x {} exceeds the limit of device '{}'", desc.width,
                                           desc.height, device.info().name),
                               fmt::format("stay within {} x {}", limit, limit));
    const bool in_pass = transient(usage);
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = desc.format,
                                 .extent = {desc.width, desc.height, 1},
                                 .mipLevels = mip_levels,
                                 .arrayLayers = 1,
                                 .samples = static_cast<VkSampleCountFlagBits>(desc.samples),
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = in_pass ? usage | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT : usage};
    check(vkCreateImage(device.handle(), &info, nullptr, &image_), fmt::format("create image {}", name));
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device.handle(), image_, &needs);
    const std::uint32_t types = needs.memoryTypeBits;
    memory_ = allocate(device, needs,
                       in_pass ? device.memory_type(types, {VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT,
                                                            VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0})
                               : device.memory_type(types, {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0}));
    check(vkBindImageMemory(device.handle(), image_, memory_, 0), fmt::format("bind image {}", name));
    const VkImageViewCreateInfo view_info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                          .image = image_,
                                          .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                          .format = desc.format,
                                          .subresourceRange = range()};
    check(vkCreateImageView(device.handle(), &view_info, nullptr, &view_),
          fmt::format("view image {}", name));
    device.name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(image_), name);
}

Image::~Image()
{
    if (!owner_)
        return;
    vkDestroyImageView(owner_->handle(), view_, nullptr);
    vkDestroyImage(owner_->handle(), image_, nullptr);
    vkFreeMemory(owner_->handle(), memory_, nullptr);
}

Image::Image(Image&& other) noexcept
{
    *this = std::move(other);
}

Image& Image::operator=(Image&& other) noexcept
{
    std::swap(owner_, other.owner_);
    std::swap(desc_, other.desc_);
    std::swap(levels_, other.levels_);
    std::swap(usage_, other.usage_);
    std::swap(image_, other.image_);
    std::swap(memory_, other.memory_);
    std::swap(view_, other.view_);
    return *this;
}

VkImageSubresourceRange Image::range() const
{
    return {.aspectMask = aspect_of(desc_.format), .levelCount = levels_, .layerCount = 1};
}

VkImageAspectFlags aspect_of(VkFormat format)
{
    return graph::is_depth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

Buffer upload_buffer(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                     const std::string& name)
{
    const Buffer staging(device, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::Write,
                         name + " staging");
    std::memcpy(staging.mapped().data(), bytes.data(), bytes.size());
    Buffer buffer(device, bytes.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, HostAccess::None, name);
    device.run_once([&](VkCommandBuffer commands) {
        const VkBufferCopy region{.size = bytes.size()};
        vkCmdCopyBuffer(commands, staging.handle(), buffer.handle(), 1, &region);
        const VkMemoryBarrier2 barrier{
            .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
            .srcStageMask = graph::access_row(graph::Usage::CopyDestination).stages,
            .srcAccessMask = graph::access_row(graph::Usage::CopyDestination).access,
            .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT};
        const VkDependencyInfo dependency{
            .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
        vkCmdPipelineBarrier2(commands, &dependency);
    });
    return buffer;
}

} // namespace gpu
