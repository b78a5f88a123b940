// Shows pictures and a user interface in a window: keeps the surface and its swapchain, makes them anew when
// the window's size changes or the system takes them away, copies pictures into place and draws the interface
// over them. One frame at a time: the next waits for the last.
#pragma once
#include "engine/gpu/command_buffer.hpp"
#include "engine/gpu/device.hpp"
#include "engine/window/ui_renderer.hpp"
#include "engine/window/window.hpp"

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace window {

/// Pixels; right and bottom are the first that do not belong to it.
struct Box
{
    std::int32_t left = 0, top = 0, right = 0, bottom = 0;
    std::int32_t width() const { return right - left; }
    std::int32_t height() const { return bottom - top; }
    bool empty() const { return right <= left || bottom <= top; }
    bool operator==(const Box&) const = default;
};

/// A picture to be scaled into a place of the window. The image is in VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
/// as Executor::presented leaves it.
struct PlacedPicture
{
    VkImage image = VK_NULL_HANDLE;
    Box from, to; // in the image; in the window
};

/// Cuts off what lies outside a window of this size, and as much of the picture.
PlacedPicture clipped(PlacedPicture picture, std::array<std::uint32_t, 2> window);

struct WindowFrame
{
    std::vector<PlacedPicture> pictures;
    std::array<float, 4> background{0, 0, 0, 1}; // sRGB-encoded, as everything a window shows
    const ImDrawData* ui = nullptr;              // sized as the window
};

class Swapchain
{
  public:
    /// Throws base::InputError when the surface takes no 8-bit colour that can be drawn and copied to.
    Swapchain(const gpu::Device& device, const Window& window);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Draws and shows a frame. False: not now (minimised, hidden, size just changed): try again later.
    bool show(const WindowFrame& frame);
    /// What show() would show, as a picture of the window's size (RGB). Empty while minimised.
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
    bool match_window(); // false: there is nothing to draw to
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
    std::vector<VkSemaphore> finished_; // by image: its frame is drawn
    bool outdated_ = true;
    VkSemaphore acquired_ = VK_NULL_HANDLE;
    gpu::CommandBuffer commands_;
};

} // namespace window
