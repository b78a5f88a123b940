// A window on the desktop (GLFW): its events, its size in pixels, files dropped on it. One per process. Opens
// before there is a device, which must offer what instance_extensions(), swapchain_extension and
// can_present() ask for (DeviceWishes).
//
// A display that goes away while the window is open ends the process with one line: X11 leaves no way to go
// on.
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
    std::array<float, 2> at{}; // where the pointer was, screen coordinates in the window
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

    /// Throws base::InputError when Vulkan cannot draw to this display at all.
    std::vector<const char*> instance_extensions() const;
    /// Whether a device's queues can show pictures in this window; for DeviceWishes::presents.
    static bool can_present(VkInstance instance, VkPhysicalDevice device, std::uint32_t queue_family);
    VkSurfaceKHR make_surface(VkInstance instance) const;

    GLFWwindow* handle() const { return window_; }
    /// Pixels; zero while minimised.
    std::array<std::uint32_t, 2> size() const;
    bool minimised() const;
    /// Pixels per unit of text: 1 on ordinary screens, 2 on those with twice the density.
    float content_scale() const;
    bool close_wanted() const;
    void keep_open(); // what was wanted is not
    void set_title(const std::string& title);

    /// Returns after at least one event; with `seconds`, at the latest then. 0: does not wait.
    void wait(std::optional<double> seconds = std::nullopt);
    /// Ends a wait. From any thread.
    static void wake();

    /// Whether what the window shows must be drawn anew: its size changed, or another window no longer hides
    /// it. Asking clears it.
    bool take_damaged();
    /// What this frame is told of the keyboard (Keyboard::take); the rest is for the next ones.
    FrameKeys take_keys(bool text_wanted) { return keyboard_.take(text_wanted); }
    /// The next press or release of a mouse button, to be taken one a frame: on a slow device the pointer is
    /// elsewhere by the time of the frame that sees it.
    std::optional<ButtonChange> take_button_change();
    /// Whether there is something left to take.
    bool has_input() const { return !keyboard_.empty() || !button_changes_.empty(); }
    /// Receives keys again after somebody else has asked GLFW for them.
    void listen_to_keys();
    /// Files dropped on the window since the last call.
    std::vector<std::filesystem::path> take_dropped();

    /// Called when the display is lost, just before the process ends: saves what it can and returns how to go
    /// on, for the user. Must not throw.
    std::function<std::string()> on_display_lost;

  private:
    void install_callbacks();

    GLFWwindow* window_ = nullptr;
    bool damaged_ = true;
    Keyboard keyboard_;
    std::deque<ButtonChange> button_changes_;
    std::array<float, 2> pointer_{}; // after the events so far
    std::vector<std::filesystem::path> dropped_;
};

} // namespace window
