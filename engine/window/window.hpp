// A window on the desktop (GLFW): its events, its size in pixels, files dropped on it. One per process. Open
// it before the device, which must meet the requirements of instance_extensions(), swapchain_extension and
// can_present() (DeviceWishes).
//
// When the display is lost, the process ends with a one-line message: X11 allows no other way.
#pragma once
#include "engine/window/keyboard.hpp"

#include <array>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>
#include <volk.h>

struct GLFWwindow;

namespace window {

/// A mouse button went down or up.
struct ButtonChange
{
    int button = 0; // GLFW_MOUSE_BUTTON_...
    bool down = false;
    std::array<float, 2> at{}; // pointer position, screen coordinates in the window
};

class Window
{
  public:
    static constexpr const char* swapchain_extension = VK_KHR_SWAPCHAIN_EXTENSION_NAME;

    /// `size` in screen coordinates. Throws base::InputError when there is no display.
    Window(const std::string& title, std::array<int, 2> size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Throws base::InputError when Vulkan cannot draw to this display.
    std::vector<const char*> instance_extensions() const;
    /// Whether a queue family can present to windows of this display; for DeviceWishes::presents.
    static bool can_present(VkInstance instance, VkPhysicalDevice device, std::uint32_t queue_family);
    VkSurfaceKHR make_surface(VkInstance instance) const;

    GLFWwindow* handle() const { return window_; }
    /// Pixels; zero while minimised.
    std::array<std::uint32_t, 2> size() const;
    bool minimised() const;
    /// Scale of text: 1 on ordinary screens, 2 on screens of twice the pixel density.
    float content_scale() const;
    bool close_wanted() const;
    void keep_open(); // cancels the request to close
    void set_title(const std::string& title);

    /// Returns after at least one event, or after `seconds`. 0: handles pending events without waiting.
    void wait(std::optional<double> seconds = std::nullopt);
    /// Ends wait(). May be called from any thread.
    static void wake();

    /// Whether the window must be redrawn because its size changed or another window no longer hides it.
    /// Clears the flag.
    bool take_damaged();
    /// Keyboard input of this frame (Keyboard::take); later frames take the rest.
    FrameKeys take_keys(bool text_wanted) { return keyboard_.take(text_wanted); }
    /// The next press or release of a mouse button, with the pointer position at that event: on a slow device
    /// the pointer has moved on by the next frame. Take one per frame.
    std::optional<ButtonChange> take_button_change();
    /// Whether keys or button changes are left to take.
    bool has_input() const { return !keyboard_.empty() || !button_changes_.empty(); }
    /// Installs the key callbacks again after other code has replaced them.
    void listen_to_keys();
    /// Files dropped on the window since the last call.
    std::vector<std::filesystem::path> take_dropped();

    /// Called when the display is lost, just before the process ends. Saves the user's work and returns
    /// advice for the error message. Must not throw.
    std::function<std::string()> on_display_lost;

  private:
    void install_callbacks();

    GLFWwindow* window_ = nullptr;
    bool damaged_ = true;
    Keyboard keyboard_;
    std::deque<ButtonChange> button_changes_;
    std::array<float, 2> pointer_{}; // at the last event
    std::vector<std::filesystem::path> dropped_;
};

} // namespace window
