// Buffers and images with their memory. Each has its own allocation: a few dozen images stay far below the
// 4096 allocations that Vulkan guarantees, so no allocator is needed.
#pragma once
#include "engine/graph/access.hpp"
#include "engine/graph/graph.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <volk.h>

namespace gpu {

class Device;

enum class HostAccess : std::uint8_t
{
    None,  // device-local
    Write, // written by the CPU, coherent
    Read,  // read by the CPU, cached if supported; call invalidate() before reading
};

class Buffer
{
  public:
    Buffer() = default;
    Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, HostAccess host,
           const std::string& name);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    VkBuffer handle() const { return buffer_; }
    VkDeviceSize size() const { return bytes_; }
    /// The whole buffer. Empty with HostAccess::None.
    std::span<std::byte> mapped() const { return {static_cast<std::byte*>(pointer_), pointer_ ? bytes_ : 0}; }
    /// Makes the device's writes visible to the CPU. The device must have made them available to the host.
    void invalidate() const;

  private:
    const Device* owner_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::size_t bytes_ = 0;
    void* pointer_ = nullptr;
    bool coherent_ = true;
};

class Image
{
  public:
    Image() = default;
    Image(const Device& device, const graph::ImageDesc& desc, std::uint32_t mip_levels,
          VkImageUsageFlags usage, const std::string& name);
    ~Image();
    Image(Image&& other) noexcept;
    Image& operator=(Image&& other) noexcept;

    VkImage handle() const { return image_; }
    VkImageView view() const { return view_; }
    const graph::ImageDesc& desc() const { return desc_; }
    VkImageUsageFlags usage() const { return usage_; }
    VkImageSubresourceRange range() const; // all mip levels

  private:
    const Device* owner_ = nullptr;
    graph::ImageDesc desc_;
    std::uint32_t levels_ = 1;
    VkImageUsageFlags usage_ = 0;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
};

VkImageAspectFlags aspect_of(VkFormat format);

/// Copies bytes to a new device-local buffer and waits.
Buffer upload_buffer(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                     const std::string& name);

} // namespace gpu
