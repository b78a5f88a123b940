// The demo's loop: waits for events, renders what changed, shows it. When nothing changes it sleeps.
#pragma once
#include <filesystem>
#include <future>
#include <memory>
#include <optional>

#include "apps/demo_events.hpp"
#include "apps/demo_ui.hpp"
#include "apps/scene_options.hpp"
#include "apps/stage.hpp"
#include "engine/executor.hpp"
#include "engine/swapchain.hpp"
#include "engine/ui.hpp"
#include "engine/window.hpp"

namespace app {

struct DemoOptions : SceneOptions
{
    double scale = 0; // of text and controls; 0: the screen's
    std::filesystem::path events, screenshot;
};

class DemoWindow
{
  public:
    /// Opens the window at once; the head is read meanwhile. Throws cicatrix::InputError without a display or
    /// a fit device.
    explicit DemoWindow(const DemoOptions& options);
    ~DemoWindow();

    /// Until the user closes the window.
    void run();

  private:
    void load(const Scene& scene);
    void finish_loading();
    void step();
    std::optional<double> patience() const; // until the next step; none: until something happens
    bool render();
    engine::WindowFrame frame(const ImDrawData* ui) const;
    void tell_idle();
    void save_screenshot();
    std::array<std::uint32_t, 2> view_pixels() const;

    DemoOptions options_;
    DemoEvents events_;
    DemoState state_;
    engine::Window window_;
    std::unique_ptr<engine::Device> device_;
    engine::ShaderLibrary shaders_;
    std::unique_ptr<engine::Executor> executor_;
    std::unique_ptr<engine::Swapchain> swapchain_;
    std::unique_ptr<engine::Ui> ui_;
    std::future<Stage::Props> loading_;
    Scene loading_scene_;
    std::unique_ptr<Stage> stage_;
    Quality quality_;
    VkImage picture_ = VK_NULL_HANDLE;
    std::array<std::uint32_t, 2> picture_size_{};
    int settle_ = 2; // steps that ImGui still needs to come to rest after an event
    bool shown_ = false, told_idle_ = false;
    double last_step_ = 0;
    std::uint64_t frames_ = 0, pictures_ = 0;
};

} // namespace app
