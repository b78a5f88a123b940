#include "engine/window/window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cstdio>
#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

#include "base/input_error.hpp"
#include "engine/gpu/vulkan_check.hpp"

// GLFW declares these only with Vulkan's own prototypes, which volk replaces.
extern "C" {
const char** glfwGetRequiredInstanceExtensions(std::uint32_t* count);
int glfwGetPhysicalDevicePresentationSupport(VkInstance instance, VkPhysicalDevice device,
                                             std::uint32_t queue_family);
VkResult glfwCreateWindowSurface(VkInstance instance, GLFWwindow* window,
                                 const VkAllocationCallbacks* allocator, VkSurfaceKHR* surface);
}

namespace window {

namespace {

using base::InputError;

constexpr const char* without_window = "cicatrix capture works without a window";

std::string last_glfw_error()
{
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "no reason given";
}

Window& self(GLFWwindow* window)
{
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

Window* the_window = nullptr; // for Xlib's error handler, which takes no user pointer

/// Xlib's I/O error handler. It ends the process itself, before Xlib prints its own message.
int display_lost(void*)
{
    std::string cure = "open the window again on a running display";
    if (the_window && the_window->on_display_lost)
        cure = the_window->on_display_lost();
    std::fputs(fmt::format("cicatrix: display: the connection was lost; {}\n", cure).c_str(), stderr);
    std::fflush(nullptr);
    ::_exit(1);
}

/// Installs the handler. GLFW loads Xlib at run time; on other window systems Xlib is not loaded.
void watch_display()
{
    void* xlib = ::dlopen("libX11.so.6", RTLD_NOW | RTLD_NOLOAD);
    if (xlib == nullptr)
        return;
    using Handler = int (*)(void*);
    using SetHandler = Handler (*)(Handler);
    if (const auto set = reinterpret_cast<SetHandler>(::dlsym(xlib, "XSetIOErrorHandler")))
        set(display_lost);
}

} // namespace

Window::Window(const std::string& title, std::array<int, 2> size)
{
    if (!glfwInit())
        throw InputError("display", fmt::format("no window can be opened: {}", last_glfw_error()),
                         fmt::format("set DISPLAY (or log in to a desktop); {}", without_window));
    watch_display();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(size[0], size[1], title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        const std::string reason = last_glfw_error();
        glfwTerminate();
        throw InputError("display", fmt::format("no window can be opened: {}", reason), without_window);
    }
    the_window = this;
    install_callbacks();
}

Window::~Window()
{
    the_window = nullptr;
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::install_callbacks()
{
    glfwSetWindowUserPointer(window_, this);
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { self(w).damaged_ = true; });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { self(w).damaged_ = true; });
    glfwSetWindowIconifyCallback(window_, [](GLFWwindow* w, int) { self(w).damaged_ = true; });
    glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* w, float, float) { self(w).damaged_ = true; });
    listen_to_keys();
    // Stored at each event, because glfwGetCursorPos returns only the current position.
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        self(w).pointer_ = {float(x), float(y)};
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
        self(w).button_changes_.push_back({button, action == GLFW_PRESS, self(w).pointer_});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
        for (int i = 0; i < count; ++i)
            self(w).dropped_.emplace_back(paths[i]);
    });
}

std::vector<const char*> Window::instance_extensions() const
{
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr)
        throw InputError(
            "Vulkan", fmt::format("it cannot draw to this display: {}", last_glfw_error()),
            fmt::format("install a driver that can (Debian: mesa-vulkan-drivers); {}", without_window));
    return {names, names + count};
}

bool Window::can_present(VkInstance instance, VkPhysicalDevice device, std::uint32_t queue_family)
{
    return glfwGetPhysicalDevicePresentationSupport(instance, device, queue_family) == GLFW_TRUE;
}

VkSurfaceKHR Window::make_surface(VkInstance instance) const
{
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    gpu::check(glfwCreateWindowSurface(instance, window_, nullptr, &surface), "draw to the window");
    return surface;
}

std::array<std::uint32_t, 2> Window::size() const
{
    if (minimised())
        return {0, 0};
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {std::uint32_t(width), std::uint32_t(height)};
}

bool Window::minimised() const
{
    return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE;
}

float Window::content_scale() const
{
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return x;
}

bool Window::close_wanted() const
{
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::keep_open()
{
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
}

void Window::set_title(const std::string& title)
{
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::wait(std::optional<double> seconds)
{
    if (!seconds)
        glfwWaitEvents();
    else if (*seconds > 0)
        glfwWaitEventsTimeout(*seconds);
    else
        glfwPollEvents();
}

void Window::wake()
{
    glfwPostEmptyEvent();
}

bool Window::take_damaged()
{
    return std::exchange(damaged_, false);
}

void Window::listen_to_keys()
{
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
        using enum KeyEvent::Kind;
        KeyEvent event{action == GLFW_PRESS ? Down : action == GLFW_REPEAT ? Repeat : Up, key};
        // Letters by character, not by key position, so that Ctrl+Z is the key Z of the user's layout.
        const char* name = glfwGetKeyName(key, scancode);
        const bool letter = name && name[0] >= 'a' && name[0] <= 'z' && name[1] == 0;
        event.press = {letter ? name[0] - 'a' + GLFW_KEY_A : key, (mods & GLFW_MOD_CONTROL) != 0,
                       (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_ALT) != 0};
        self(w).keyboard_.add(event);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned character) {
        self(w).keyboard_.add({.kind = KeyEvent::Kind::Text, .text = character});
    });
}

std::optional<ButtonChange> Window::take_button_change()
{
    if (button_changes_.empty())
        return std::nullopt;
    const ButtonChange change = button_changes_.front();
    button_changes_.pop_front();
    return change;
}

std::vector<std::filesystem::path> Window::take_dropped()
{
    return std::exchange(dropped_, {});
}

} // namespace window
