#include "apps/demo/demo_window.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>
#include <unistd.h>

#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "scene/file.hpp"
#include "wound/healing/healing.hpp"

namespace demo_command {
namespace {

constexpr std::array<int, 2> first_size{1280, 720};
constexpr double light_rest_s = .4;  // s, after which light that stands is kept on the skin
constexpr double frame_s = 1.0 / 60; // s, the shortest time between frames of playback and fades

gpu::DeviceOptions window_device(const DemoOptions& options, const window::Window& window)
{
    gpu::DeviceOptions device = stage::device_options(options);
    device.instance_extensions = window.instance_extensions();
    device.wishes = {{window::Window::swapchain_extension}, window::Window::can_present};
    return device;
}

} // namespace

DemoWindow::DemoWindow(const DemoOptions& options)
    : options_(options), events_(options.events), window_("Cicatrix", first_size)
{
    events_.tell("window"); // open, still empty
    window_.on_display_lost = [this] { return rescue(); };
    on_disk_ = state_.scene = scene::chosen_scene(options_);
    state_.scene_file = options_.scene;
    loading_ = std::async(std::launch::async, [scene = state_.scene] {
        stage::Stage::Preparation preparation = stage::Stage::prepare(scene);
        window::Window::wake();
        return preparation;
    }); // runs while the device is opened
    renderer_ = std::make_unique<stage::Renderer>(window_device(options_, window_));
    swapchain_ = std::make_unique<window::Swapchain>(renderer_->device, window_);
    ui_ = std::make_unique<window::Ui>(window_, options_.scale);
    state_.device = renderer_->device.info().name;
}

DemoWindow::~DemoWindow()
{
    if (loading_.valid())
        loading_.wait();
}

void DemoWindow::run()
{
    last_step_ = now_s();
    while (!may_close()) {
        const std::optional<double> wait = seconds_to_wait();
        if (!wait)
            tell_idle();
        if (state_.wishes.quit)
            continue;
        window_.wait(wait);
        settle_ = wait ? std::max(0, settle_ - 1) : 2;
        step();
    }
    stage::fail_on_validation(renderer_->device);
    events_.tell("end");
}

bool DemoWindow::may_close()
{
    if (!window_.close_wanted() && !state_.wishes.quit)
        return false;
    if (!unsaved() || state_.dialog == Dialog::Quit)
        return true;
    window_.keep_open();
    state_.wishes.stop_film = recording_.has_value();
    state_.wishes.quit = recording_.has_value(); // quit again when the recording has stopped
    if (!recording_)
        open_dialog(state_, Dialog::Quit);
    settle_ = 2;
    return false;
}

std::optional<double> DemoWindow::seconds_to_wait() const
{
    const double now = now_s();
    if (window_.minimised())
        return std::nullopt;
    if (!on_screen_)
        return .05; // the swapchain had no image: try again
    if (settle_ > 0 || recording_ || window_.has_input())
        return 0;
    if (state_.playback.playing || now < fading_until_)
        return std::max(0.0, frame_s - (now - last_step_));
    std::optional<double> wait = quality_.due_in(now);
    const auto at_most = [&](double seconds) {
        wait = std::min(wait.value_or(seconds), std::max(0.0, seconds));
    };
    if (state_.loading || (stage_ && stage_->pending()) || (compared_ && compared_->pending()))
        at_most(.03);
    if (stage_ && !compared_ && !light_.rested)
        at_most(std::max(light_.since + light_rest_s - now, .05));
    if (stage_ && now < light_.scene_since + light_rest_s)
        at_most(light_.scene_since + light_rest_s - now);
    if (const std::optional<double> notice = state_.notices.next_change())
        at_most(*notice - now);
    return wait;
}

void DemoWindow::step()
{
    const double now = now_s(), passed = std::exchange(last_step_, now);
    finish_loading();
    if (window_.minimised())
        return;
    const window::FrameKeys keys = window_.take_keys(ImGui::GetIO().WantTextInput);
    for (const window::KeyPress& key : keys.presses)
        press(state_, key, ImGui::GetIO().WantTextInput);
    for (const std::filesystem::path& file : window_.take_dropped())
        open(file);
    state_.playback.advance(std::min(now - passed, .25));
    state_.notices.drop_old(now);
    state_.scale = ui_->scale();
    tell_facts();
    if (recording_)
        record_picture(); // before the interface uses the preview, which this replaces
    ui_->begin(swapchain_->ui(), keys);
    draw_demo(state_);
    if (std::exchange(shown_dialog_, state_.dialog) != state_.dialog)
        fading_until_ = now + .25;
    const ImDrawData* drawn = ui_->end();
    if (!recording_)
        apply_edits();
    if (state_.moving || state_.playback.playing || ImGui::GetIO().MouseWheel != 0)
        quality_.moving(now);
    if (std::exchange(shown_notices_, state_.notices.list().size()) != state_.notices.list().size())
        settle_ = 2; // ImGui resizes their window one frame later
    const bool rendered = render();
    if (!window_.take_damaged() && !rendered && !ui_->changed() && on_screen_)
        return; // the screen is up to date
    on_screen_ = swapchain_->show(frame(drawn));
    frames_ += on_screen_;
    if (on_screen_ && pictures_ > 0 && !std::exchange(told_picture_, true))
        events_.tell("picture"); // the first
    told_idle_ = false;
}

void DemoWindow::finish_loading()
{
    if (!loading_.valid() || loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    settle_ = 2;
    stage_ = std::make_unique<stage::Stage>(renderer_->device, loading_.get());
    state_.loading = false;
    state_.playback.day = state_.scene.days.front();
    state_.mended = is_published(state_.scene) ? scene::Scene{} : state_.scene;
    history_ = History(state_.scene);
    for (const std::string& note : stage_->loaded().notes)
        state_.notices.say(note, now_s());
}

/// Copies facts about the stage to the interface, which is drawn before the picture below it.
void DemoWindow::tell_facts()
{
    if (!stage_)
        return;
    StageFacts& facts = state_.stage;
    facts.anchors = stage_->loaded().anchors();
    facts.scene_wounds.clear();
    for (const scene::PlacedWound& wound : stage_->loaded().wounds)
        facts.scene_wounds.push_back(wound.scene_wound);
    const head::Camera camera = stage_->loaded().camera();
    const auto [width, height] = view_pixels();
    if (width > 0 && height > 0)
        facts.sight = Sight(stage_->view(camera, std::array<std::uint32_t, 2>{width, height}));
    facts.head_middle = stage_->loaded().head_middle();
    facts.camera_distance_m = stage_->loaded().distance(stage_->scene().camera);
    facts.pending = stage_->pending() || (compared_ && compared_->pending());
    state_.can_undo = history_.can_undo();
    state_.can_redo = history_.can_redo();
    const std::vector<scene::Wound>& wounds = state_.scene.wounds;
    const double closure =
        wounds.empty() ? std::numeric_limits<double>::infinity()
                       : wound::closure_day(
                             wounds[std::min(state_.selected.value_or(0), wounds.size() - 1)].healing.curve);
    state_.playback.axis = TimelineAxis(closure, std::ranges::max(state_.scene.days));
    state_.playback.seek(state_.playback.day);
}

std::array<std::uint32_t, 2> DemoWindow::view_pixels() const
{
    const float pixels = ui_->pixels_per_unit();
    return {std::uint32_t(std::max(0.0f, std::round(state_.view.width * pixels))),
            std::uint32_t(std::max(0.0f, std::round(state_.view.height * pixels)))};
}

bool DemoWindow::render()
{
    const std::array<std::uint32_t, 2> full = view_pixels();
    if (!stage_ || recording_ || full[0] < 16 || full[1] < 16)
        return false;
    watch_light(full[1]);
    const double scale = quality_.scale(now_s());
    Drawn drawn = draw_picture(1);
    if (drawn == Drawn::NotNow)
        drawn = draw_picture(scale);
    return drawn == Drawn::Now;
}

void DemoWindow::watch_light(std::uint32_t height)
{
    const double now = now_s();
    light_.scene.camera = stage_->scene().camera; // does not concern the light
    const bool changed = stage_->pending() || light_.scene != stage_->scene();
    if (compared_ || changed || light_.day != state_.playback.day)
        light_ = {stage_->scene(), state_.playback.day, now, changed ? now : light_.scene_since,
                  false,           std::nullopt};
    else if (now >= light_.since + light_rest_s && quality_.scale(now) == 1 && !state_.moving) {
        light_.rested = true;
        light_.scale = stage_->light_scale(stage_->loaded().camera(), height);
    }
}

/// Draws the picture at `scale` unless it is up to date; at full scale, not while something moves.
DemoWindow::Drawn DemoWindow::draw_picture(double scale)
{
    const std::array<std::uint32_t, 2> full = view_pixels();
    const std::array<std::uint32_t, 2> size{std::max(16u, std::uint32_t(std::lround(full[0] * scale))),
                                            std::max(16u, std::uint32_t(std::lround(full[1] * scale)))};
    graph::Graph graph;
    const double day = state_.playback.day;
    const stage::FrameRequest now{.day = day,
                                  .tile = size,
                                  .every_frame = false,
                                  .light_scale = light_.scale,
                                  .radiance = false,
                                  .lights_rest = now_s() >= light_.scene_since + light_rest_s};
    stage::FrameRequest other = now;
    other.day = compared_day(day);
    const graph::ImageId picture =
        compared_ ? stage::declare_split(graph, *stage_, now, *compared_, other, state_.divider)
                  : stage_->declare(graph, now).images.picture;
    graph.present(picture);
    if (picture_ != VK_NULL_HANDLE && renderer_->executor.up_to_date(graph))
        return Drawn::Already;
    if (scale == 1 && quality_.scale(now_s()) < 1)
        return Drawn::NotNow; // something moves
    const gpu::FrameResult result = renderer_->executor.run(graph);
    picture_ = renderer_->executor.presented(graph.images[picture.index].name);
    picture_size_ = size;
    quality_.rendered(scale, result.frame_ms);
    state_.passes = result.passes;
    state_.frame_ms = result.frame_ms;
    state_.render_scale = scale;
    ++pictures_;
    settle_ = std::max(settle_, 1); // to show the new times in the panel
    return Drawn::Now;
}

window::WindowFrame DemoWindow::frame(const ImDrawData* ui) const
{
    window::WindowFrame frame{{}, {.07f, .07f, .08f, 1}, ui};
    if (picture_ == VK_NULL_HANDLE)
        return frame;
    const float pixels = ui_->pixels_per_unit();
    const auto left = std::int32_t(std::lround(state_.view.left * pixels)),
               top = std::int32_t(std::lround(state_.view.top * pixels));
    const auto [width, height] = view_pixels();
    frame.pictures.push_back({picture_,
                              {0, 0, std::int32_t(picture_size_[0]), std::int32_t(picture_size_[1])},
                              {left, top, left + std::int32_t(width), top + std::int32_t(height)}});
    return frame;
}

void DemoWindow::tell_idle()
{
    if (std::exchange(told_idle_, true) || !stage_)
        return;
    if (!options_.screenshot.empty())
        save_screenshot();
    if (!events_.wanted())
        return;
    const float pixels = ui_->pixels_per_unit();
    const auto box = [&](const Rectangle& r) {
        return nlohmann::json{r.left * pixels, r.top * pixels, r.width * pixels, r.height * pixels};
    };
    nlohmann::json wounds = nlohmann::json::array(), notices = nlohmann::json::array();
    for (std::size_t i = 0; i < stage_->loaded().anchors().size(); ++i)
        if (const auto at = state_.stage.sight.project(stage_->loaded().wounds[i].anchor.centre))
            wounds.push_back({{"wound", stage_->loaded().wounds[i].scene_wound},
                              {"at",
                               {(state_.view.left + at->x * state_.view.width) * pixels,
                                (state_.view.top + at->y * state_.view.height) * pixels}}});
    for (const Notice& notice : state_.notices.list())
        notices.push_back(notice.text);
    events_.tell("idle", {{"frames", frames_},
                          {"pictures", pictures_},
                          {"day", state_.playback.day},
                          {"window", window_.size()},
                          {"view", box(state_.view)},
                          {"timeline", box(state_.timeline)},
                          {"wounds", wounds},
                          {"selected", state_.selected ? nlohmann::json(*state_.selected) : nullptr},
                          {"dialog", int(state_.dialog)},
                          {"photo", box(state_.entries.shown)},
                          {"divider", state_.divider},
                          {"notices", notices}});
}

std::string DemoWindow::rescue() const
{
    const std::string advice = "open the window again on a running display";
    if (!stage_ || state_.scene == on_disk_)
        return advice;
    const std::filesystem::path file = base::cache_folder() / fmt::format("rescued-{}.json", ::getpid());
    try {
        base::make_folder(file.parent_path());
        scene::save_scene(file, state_.scene);
        return fmt::format("the scene with its edits is in {}; {} with it: cicatrix demo {}", file.string(),
                           advice, file.string());
    } catch (const std::exception& error) {
        return fmt::format("the edits are lost: {}; {}", error.what(), advice);
    }
}

void DemoWindow::save_screenshot()
{
    base::write_png(options_.screenshot, swapchain_->picture_of(frame(ImGui::GetDrawData())));
    state_.wishes.quit = true;
}

} // namespace demo_command
