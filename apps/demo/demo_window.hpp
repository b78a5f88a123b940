// The demo's main loop: waits for events, renders what changed and shows it; sleeps while nothing changes.
#pragma once
#include <filesystem>
#include <future>
#include <memory>
#include <optional>

#include "apps/demo/events.hpp"
#include "apps/demo/history.hpp"
#include "apps/demo/ui.hpp"
#include "base/film.hpp"
#include "engine/window/swapchain.hpp"
#include "engine/window/ui.hpp"
#include "engine/window/window.hpp"
#include "scene/command_line.hpp"
#include "stage/renderer.hpp"
#include "stage/stage.hpp"

namespace demo_command {

struct DemoOptions : scene::SceneOptions
{
    double scale = 0; // of text and controls; 0: the screen's scale
    std::filesystem::path events, screenshot;
};

class DemoWindow
{
  public:
    /// Opens the window and reads the head in the background. Throws base::InputError without a display or a
    /// suitable device.
    explicit DemoWindow(const DemoOptions& options);
    ~DemoWindow();

    /// Returns when the user closes the window.
    void run();

  private:
    // The loop.
    void step();
    bool may_close();                              // shows the Quit dialog when there are unsaved edits
    std::optional<double> seconds_to_wait() const; // until the next step; none: until an event
    void finish_loading();
    void tell_idle();

    // What is shown.
    bool render();
    enum class Drawn : std::uint8_t
    {
        Already, // the picture is up to date
        Now,
        NotNow // something moves: draw at a smaller scale
    };
    Drawn draw_picture(double scale);
    void watch_light(std::uint32_t height);
    window::WindowFrame frame(const ImDrawData* ui) const;
    std::array<std::uint32_t, 2> view_pixels() const;
    void tell_facts(); // to the interface
    void save_screenshot();
    std::string rescue() const; // saves the scene when the display is lost; returns advice for the user

    // Edits; each shows its errors as notices in the window.
    void apply_edits();
    void show_scene();
    void match_comparison();
    double compared_day(double day) const { return state_.compare == Compare::Day0 ? 0 : day; }
    scene::Scene compared_scene() const;
    bool unsaved() const; // there are edits of more than the camera
    void grant_wishes();
    void grant_edits();
    std::optional<glm::dvec3> place_at(const glm::dvec2& at) const; // on the skin; `at`: 0..1 of the view
    /// Says so in a notice when there is none.
    bool has_room_for_wound();
    void put_wound(const glm::dvec2& at);
    void move_wound(const glm::dvec2& to);
    void go_to(const scene::Scene& scene);

    // Files.
    void open(const std::filesystem::path& file);
    void open_scene(const std::filesystem::path& file);
    void open_photo(const std::filesystem::path& file, std::optional<std::size_t> wound);
    void use_photo();
    void save_scene(std::filesystem::path file);
    void save_picture(std::filesystem::path file);
    void start_film(std::filesystem::path file);
    void record_picture(); // the next frame of the film
    cv::Mat3b picture_of(double day,
                         const stage::DrawOptions& options); // as the window shows it, split or not
    void show_in_dialog(const cv::Mat3b& picture);
    template <typename Work>
    void attempt(Work work); // shows a base::InputError as a notice

    DemoOptions options_;
    DemoEvents events_;
    DemoState state_;
    window::Window window_;
    std::unique_ptr<stage::Renderer> renderer_;
    std::unique_ptr<window::Swapchain> swapchain_;
    std::unique_ptr<window::Ui> ui_;
    std::unique_ptr<gpu::Texture> photo_; // shown in the dialog
    struct Recording
    {
        std::unique_ptr<base::Film> film;
        std::filesystem::path file;
        stage::DrawOptions options;
        std::size_t next = 0, pictures = 0;
    };
    std::optional<Recording> recording_;
    std::future<stage::Stage::Preparation> loading_;
    std::unique_ptr<stage::Stage> stage_;
    std::optional<stage::Stage> compared_; // shown right of the divider
    History history_{scene::Scene{}};
    scene::Scene on_disk_; // as last read or saved
    /// Light that is kept on the skin: since when the scene's light, wounds and day have stood, and at which
    /// scale of the atlas it was last drawn at rest. While a camera moves the scale stays.
    struct StandingLight
    {
        scene::Scene scene; // its camera does not matter
        double day = -1, since = 0;
        double scene_since = 0; // since when all but the day has stood
        bool rested = false;
        std::optional<double> scale;
    };
    StandingLight light_;
    Quality quality_;
    VkImage picture_ = VK_NULL_HANDLE;
    std::array<std::uint32_t, 2> picture_size_{};
    int settle_ = 2; // steps that ImGui still needs after an event to complete its layout
    bool on_screen_ = false, told_idle_ = false, told_picture_ = false;
    double last_step_ = 0, fading_until_ = 0; // ImGui dims the window behind a dialog
    Dialog shown_dialog_ = Dialog::None;
    std::size_t shown_notices_ = 0;
    std::uint64_t frames_ = 0, pictures_ = 0;
};

} // namespace demo_command
