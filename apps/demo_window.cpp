#include "apps/demo_window.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

#include "engine/image_io.hpp"
#include "wound/input_error.hpp"

namespace app {
namespace {

constexpr std::array<int, 2> first_size{1280, 720};
constexpr double frame_s = 1.0 / 60; // no display shows more

} // namespace

DemoWindow::DemoWindow(const DemoOptions& options)
    : options_(options), events_(options.events), window_("Cicatrix", first_size)
{
    load(chosen_scene(options_)); // on another thread, while the device is opened
    engine::DeviceOptions wanted = device_options(options_);
    wanted.instance_extensions = window_.instance_extensions();
    wanted.wishes = {{engine::Window::swapchain_extension}, engine::Window::can_present};
    device_ = std::make_unique<engine::Device>(wanted);
    executor_ = std::make_unique<engine::Executor>(*device_, shaders_);
    swapchain_ = std::make_unique<engine::Swapchain>(*device_, window_);
    ui_ = std::make_unique<engine::Ui>(window_, options_.scale);
    state_.device = device_->info().name;
}

DemoWindow::~DemoWindow()
{
    if (loading_.valid())
        loading_.wait();
}

void DemoWindow::load(const Scene& scene)
{
    loading_scene_ = scene;
    state_.loading = true;
    loading_ = std::async(std::launch::async, [scene] {
        Stage::Props props = Stage::prepare(scene);
        engine::Window::wake();
        return props;
    });
}

void DemoWindow::finish_loading()
{
    if (!loading_.valid() || loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    state_.loading = false;
    settle_ = 2;
    try {
        stage_ = std::make_unique<Stage>(*device_, loading_scene_, loading_.get());
        state_.scene = loading_scene_;
        state_.playback.last_day = std::max(1.0, *std::ranges::max_element(state_.scene.days));
        for (const std::string& note : stage_->notes())
            state_.notices.say(note, now_s());
    } catch (const cicatrix::InputError& error) {
        if (!stage_)
            throw;
        state_.notices.fail(error.what());
    }
}

void DemoWindow::run()
{
    last_step_ = now_s();
    while (!window_.close_wanted() && !state_.wishes.quit) {
        const std::optional<double> wait = patience();
        if (!wait)
            tell_idle();
        const std::uint64_t before = frames_;
        window_.wait(wait);
        settle_ = wait ? std::max(0, settle_ - 1) : 2;
        step();
        told_idle_ = told_idle_ && frames_ == before;
    }
    const std::vector<std::string> messages = device_->validation_messages();
    if (!messages.empty())
        throw std::runtime_error(
            fmt::format("{} validation messages; the first: {}", messages.size(), messages.front()));
    events_.tell("end");
}

std::optional<double> DemoWindow::patience() const
{
    const double now = now_s();
    if (window_.minimised())
        return std::nullopt;
    if (!shown_)
        return .05; // the window gave no image
    if (settle_ > 0)
        return 0;
    if (state_.playback.playing)
        return std::max(0.0, frame_s - (now - last_step_));
    if (state_.loading)
        return .1;
    std::optional<double> wait = quality_.due_in(now);
    if (const std::optional<double> notice = state_.notices.next_change())
        wait = std::min(wait.value_or(1e9), std::max(0.0, *notice - now));
    return wait;
}

std::array<std::uint32_t, 2> DemoWindow::view_pixels() const
{
    const float pixels = ui_->pixels_per_unit();
    return {std::uint32_t(std::max(0.0f, std::round(state_.view.width * pixels))),
            std::uint32_t(std::max(0.0f, std::round(state_.view.height * pixels)))};
}

void DemoWindow::step()
{
    const double now = now_s(), passed = std::exchange(last_step_, now);
    shown_ = window_.minimised();
    finish_loading();
    if (window_.minimised())
        return;
    state_.playback.advance(std::min(now - passed, .25));
    state_.notices.drop_old(now);
    state_.scale = ui_->scale();
    ui_->begin(swapchain_->ui());
    draw_demo(state_);
    const ImDrawData* drawn = ui_->end();
    if (state_.moving || state_.playback.playing)
        quality_.moving(now);
    const bool rendered = render();
    const bool damaged = window_.take_damaged();
    if (!rendered && !ui_->changed() && !damaged && told_idle_) {
        shown_ = true;
        return;
    }
    shown_ = swapchain_->show(frame(drawn));
    frames_ += shown_;
}

bool DemoWindow::render()
{
    const std::array<std::uint32_t, 2> full = view_pixels();
    if (!stage_ || full[0] < 16 || full[1] < 16)
        return false;
    const double scale = quality_.scale(now_s());
    const std::array<std::uint32_t, 2> size{std::max(16u, std::uint32_t(std::lround(full[0] * scale))),
                                            std::max(16u, std::uint32_t(std::lround(full[1] * scale)))};
    engine::Graph graph;
    const passes::FrameImages images = stage_->declare(graph, stage_->wounds_on(state_.playback.day),
                                                       stage_->camera(), state_.scene.shading, size);
    graph.present(images.picture);
    const std::string name = graph.images[images.picture.index].name;
    const engine::FrameResult result = executor_->run(graph);
    picture_ = executor_->presented(name);
    picture_size_ = size;
    quality_.rendered(scale, result.frame_ms);
    state_.passes = result.passes;
    state_.frame_ms = result.frame_ms;
    state_.render_scale = scale;
    ++pictures_;
    return true;
}

engine::WindowFrame DemoWindow::frame(const ImDrawData* ui) const
{
    engine::WindowFrame frame{{}, {.07f, .07f, .08f, 1}, ui};
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
    if (std::exchange(told_idle_, true))
        return;
    if (!options_.screenshot.empty())
        save_screenshot();
    if (!events_.wanted())
        return;
    const auto box = [&](const Rectangle& r) {
        const float pixels = ui_->pixels_per_unit();
        return nlohmann::json{r.left * pixels, r.top * pixels, r.width * pixels, r.height * pixels};
    };
    events_.tell("idle", {{"frames", frames_},
                          {"pictures", pictures_},
                          {"day", state_.playback.day},
                          {"window", window_.size()},
                          {"view", box(state_.view)},
                          {"timeline", box(state_.timeline)}});
}

void DemoWindow::save_screenshot()
{
    ImGui::GetDrawData(); // of the last step
    engine::write_png(options_.screenshot, swapchain_->picture_of(frame(ImGui::GetDrawData())));
    state_.wishes.quit = true;
    engine::Window::wake();
}

} // namespace app
