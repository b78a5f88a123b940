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

    VkBuffer handle() const { return buffer; }
    VkDeviceSize size() const { return bytes; }
    /// The whole of it. Empty when the host has no access.
    std::span<std::byte> mapped() const { return {static_cast<std::byte*>(pointer), pointer ? bytes : 0}; }
    /// Makes what the device wrote, and made available to the host, visible to the CPU.
    void invalidate() const;

  private:
    const Device* owner = nullptr;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::size_t bytes = 0;
    void* pointer = nullptr;
    bool coherent = true;
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

    VkImage handle() const { return image; }
    VkImageView view() const { return image_view; }
    const graph::ImageDesc& desc() const { return description; }
    VkImageUsageFlags usage() const { return image_usage; }
    VkImageSubresourceRange range() const; // all of it

  private:
    const Device* owner = nullptr;
    graph::ImageDesc description;
    std::uint32_t levels = 1;
    VkImageUsageFlags image_usage = 0;
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView image_view = VK_NULL_HANDLE;
};

VkImageAspectFlags aspect_of(VkFormat format);

/// Sends bytes to a new buffer on the device and waits.
Buffer upload_buffer(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                     const std::string& name);

} // namespace gpu
