// Shows pictures and a user interface in a window: owns the surface and its swapchain, recreates them when
// the window's size changes or the surface is lost, copies the pictures and draws the interface over them.
// One frame at a time: the next waits for the last.
#pragma once
#include "engine/gpu/command_buffer.hpp"
#include "engine/gpu/device.hpp"
#include "engine/window/ui_renderer.hpp"
#include "engine/window/window.hpp"

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace window {

/// Pixels; right and bottom are exclusive.
struct Box
{
    std::int32_t left = 0, top = 0, right = 0, bottom = 0;
    std::int32_t width() const { return right - left; }
    std::int32_t height() const { return bottom - top; }
    bool empty() const { return right <= left || bottom <= top; }
    bool operator==(const Box&) const = default;
};

/// A picture to be scaled into a box of the window. The image is in VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, as
/// after Executor::presented.
struct PlacedPicture
{
    VkImage image = VK_NULL_HANDLE;
    Box from, to; // in the image; in the window
};

/// Clips `to` to a window of this size and `from` accordingly.
PlacedPicture clipped(PlacedPicture picture, std::array<std::uint32_t, 2> window);

struct WindowFrame
{
    std::vector<PlacedPicture> pictures;
    std::array<float, 4> background{0, 0, 0, 1}; // sRGB-encoded, as all window contents
    const ImDrawData* ui = nullptr;              // of the window's size
};

class Swapchain
{
  public:
    /// Throws base::InputError when the surface has no UNORM colour format that can be drawn and copied to.
    Swapchain(const gpu::Device& device, const Window& window);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Draws and shows a frame. False (minimised, hidden, size just changed): try again later.
    bool show(const WindowFrame& frame);
    /// The frame as show() would draw it, as a picture of the window's size (RGB). Empty while minimised.
    cv::Mat3b picture_of(const WindowFrame& frame);
    UiRenderer& ui() { return ui_renderer_; }

  private:
    struct Target
    {
        VkImage image = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
        VkExtent2D size{};
        VkFormat format = VK_FORMAT_UNDEFINED;
    };
    void make_surface();
    bool match_window(); // false: nothing can be drawn now
    void make_swapchain(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D size);
    void destroy_swapchain();
    void destroy();
    void lose_surface();
    void record(VkCommandBuffer commands, const WindowFrame& frame, const Target& target,
                VkImageLayout final_layout);

    const gpu::Device& device_;
    const Window& window_;
    UiRenderer ui_renderer_;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format_{};
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<Target> targets_;
    std::vector<VkSemaphore> finished_; // by image: signalled when its frame is drawn
    bool outdated_ = true;
    VkSemaphore acquired_ = VK_NULL_HANDLE;
    gpu::CommandBuffer commands_;
};

} // namespace window
