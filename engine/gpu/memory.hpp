// Buffers and images with the memory behind them. Each has an allocation of its own: a renderer of a few
// dozen images stays far below the 4096 allocations every device grants, and an allocator would be one more
// thing to get wrong.
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
    None,  // on the device
    Write, // written by the CPU, coherent
    Read,  // read by the CPU, cached where the device can; call invalidate() before reading
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
    /// The whole of it. Empty when the host has no access.
    std::span<std::byte> mapped() const { return {static_cast<std::byte*>(pointer_), pointer_ ? bytes_ : 0}; }
    /// Makes what the device wrote, and made available to the host, visible to the CPU.
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
    VkImageSubresourceRange range() const; // all of it

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

/// Sends bytes to a new buffer on the device and waits.
Buffer upload_buffer(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                     const std::string& name);

} // namespace gpu
