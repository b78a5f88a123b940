// The demo's edits and files: carries out the requests of the interface (DemoState::Wishes).
#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>
#include <opencv2/imgproc.hpp>

#include "apps/demo/demo_window.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "scene/file.hpp"
#include "shaders/shared/frame.h"

namespace demo_command {
namespace {

constexpr std::size_t max_wounds = shared::MAX_WOUNDS;

std::string lower_extension(const std::filesystem::path& file)
{
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

/// `scene` with the camera of `now`.
scene::Scene with_camera_of(scene::Scene scene, const scene::Scene& now)
{
    scene.camera = now.camera;
    return scene;
}

} // namespace

template <typename Work>
void DemoWindow::attempt(Work work)
{
    try {
        work();
    } catch (const base::InputError& error) {
        state_.notices.fail(error.what());
        settle_ = 2;
    }
}

void DemoWindow::apply_edits()
{
    if (!stage_) {
        const bool quit = state_.wishes.quit;
        state_.wishes = {};
        state_.wishes.quit = quit;
        return;
    }
    grant_edits();
    grant_wishes();
    show_scene();
    attempt([&] { match_comparison(); });
    // One undo step is one whole drag or input. Camera moves are not undo steps.
    const bool busy = state_.moving || ImGui::IsAnyItemActive();
    if (!busy && with_camera_of(state_.scene, history_.now()) != history_.now())
        history_.edit(state_.scene, "");
}

void DemoWindow::show_scene()
{
    try {
        const std::vector<scene::Wound>& shown = stage_->scene().wounds;
        for (std::size_t i = 0; shown.size() == state_.scene.wounds.size() && i < shown.size(); ++i)
            scene::follow_usual_course(shown[i], state_.scene.wounds[i]);
        if (state_.scene != stage_->scene())
            stage_->update(state_.scene);
        if (stage_->poll())
            settle_ = 2;
    } catch (const base::InputError& error) {
        state_.notices.fail(error.what());
        state_.scene = with_camera_of(stage_->scene(), state_.scene);
        settle_ = 2;
    }
}

scene::Scene DemoWindow::compared_scene() const
{
    if (state_.compare == Compare::Kept && state_.kept)
        return with_camera_of(*state_.kept, state_.scene);
    scene::Scene scene = state_.scene;
    if (state_.compare == Compare::Mode)
        set_published(scene, !is_published(scene), state_.mended);
    return scene;
}

void DemoWindow::match_comparison()
{
    if (state_.compare == Compare::Nothing) {
        compared_.reset();
        return;
    }
    if (!compared_)
        compared_.emplace(*stage_);
    const scene::Scene wanted = compared_scene();
    if (compared_->scene() != wanted)
        compared_->update(wanted);
    if (compared_->poll())
        settle_ = 2;
}

bool DemoWindow::unsaved() const
{
    return stage_ && with_camera_of(state_.scene, on_disk_) != on_disk_;
}

void DemoWindow::go_to(const scene::Scene& scene)
{
    state_.scene = with_camera_of(scene, state_.scene);
    settle_ = 2;
}

void DemoWindow::grant_edits()
{
    DemoState::Wishes& wishes = state_.wishes;
    if (std::exchange(wishes.undo, false) && history_.can_undo())
        go_to(history_.undo());
    if (std::exchange(wishes.redo, false) && history_.can_redo())
        go_to(history_.redo());
    if (const auto at = std::exchange(wishes.wound_at, std::nullopt))
        put_wound(*at);
    if (const auto to = std::exchange(wishes.move_to, std::nullopt))
        move_wound(*to);
}

void DemoWindow::grant_wishes()
{
    DemoState::Wishes& wishes = state_.wishes;
    if (const auto file = std::exchange(wishes.open, std::nullopt))
        open(*file);
    if (const auto file = std::exchange(wishes.save_scene, std::nullopt))
        save_scene(*file);
    if (const auto file = std::exchange(wishes.save_picture, std::nullopt))
        save_picture(*file);
    if (const auto wound = std::exchange(wishes.photo_area, std::nullopt))
        open_photo(state_.scene.wounds.at(*wound).photo, wound);
    if (const auto file = std::exchange(wishes.film, std::nullopt))
        start_film(*file);
    if (std::exchange(wishes.use_photo, false))
        use_photo();
}

std::optional<glm::dvec3> DemoWindow::place_at(const glm::dvec2& at) const
{
    return stage_->loaded().pick(stage_->loaded().camera(), 2 * at.x - 1, 2 * at.y - 1,
                                 double(state_.view.width) / state_.view.height);
}

bool DemoWindow::has_room_for_wound()
{
    if (state_.scene.wounds.size() < max_wounds)
        return true;
    state_.notices.say(fmt::format("A scene has room for {} wounds; delete one first.", max_wounds), now_s());
    return false;
}

void DemoWindow::put_wound(const glm::dvec2& at)
{
    const auto place = place_at(at);
    if (!place) {
        state_.selected.reset(); // the click missed the head
        return;
    }
    if (!has_room_for_wound())
        return;
    scene::Wound wound = next_wound(state_.scene);
    wound.place = *place;
    state_.selected = state_.scene.wounds.size();
    state_.scene.wounds.push_back(wound);
}

void DemoWindow::move_wound(const glm::dvec2& to)
{
    const auto place = place_at(to);
    if (place && state_.selected && *state_.selected < state_.scene.wounds.size())
        state_.scene.wounds[*state_.selected].place = *place;
}

void DemoWindow::open(const std::filesystem::path& file)
{
    const std::string extension = lower_extension(file);
    attempt([&] {
        if (!std::filesystem::exists(file))
            throw base::InputError(file.string(), "does not exist", "check the name");
        if (extension == ".json")
            open_scene(file);
        else if (extension == ".glb" || extension == ".gltf")
            state_.scene.head = std::filesystem::absolute(file);
        else if (extension == ".png" || extension == ".jpg" || extension == ".jpeg")
            open_photo(file, std::nullopt);
        else
            throw base::InputError(file.string(), "is neither a scene, a head nor a photo",
                                   "give a .json, .glb, .gltf, .png or .jpg");
    });
}

void DemoWindow::open_scene(const std::filesystem::path& file)
{
    const scene::Scene scene = scene::read_scene(file);
    stage_->update(scene); // throws for an invalid scene, before any state here changes
    on_disk_ = state_.scene = scene;
    state_.scene_file = file;
    state_.selected.reset();
    state_.playback = {.day = scene.days.front(), .days_per_second = state_.playback.days_per_second};
    if (!is_published(scene))
        state_.mended = scene;
}

void DemoWindow::open_photo(const std::filesystem::path& file, std::optional<std::size_t> wound)
{
    attempt([&] {
        const cv::Mat3b photo = base::read_rgb(file);
        show_in_dialog(photo);
        state_.entries.pixels = {photo.cols, photo.rows};
        state_.entries.photo = std::filesystem::absolute(file);
        state_.entries.wound = wound;
        state_.entries.rectangle.reset();
        if (wound && state_.scene.wounds[*wound].segmentation.rect)
            state_.entries.rectangle = cv::Rect2d(*state_.scene.wounds[*wound].segmentation.rect);
        state_.dialog = Dialog::Area;
        settle_ = 2;
    });
}

void DemoWindow::show_in_dialog(const cv::Mat3b& picture)
{
    cv::Mat3b small = picture;
    if (const double shrink = 1600.0 / std::max(picture.cols, picture.rows); shrink < 1)
        cv::resize(picture, small, {}, shrink, shrink, cv::INTER_AREA);
    cv::Mat4b rgba;
    cv::cvtColor(small, rgba, cv::COLOR_RGB2RGBA);
    vkQueueWaitIdle(renderer_->device.queue()); // the last frame may still use the old texture
    photo_ = std::make_unique<gpu::Texture>(renderer_->device, rgba, gpu::Encoding::Linear, false, "photo");
    state_.entries.picture = photo_.get();
}

void DemoWindow::use_photo()
{
    const DemoState::Entries& entries = state_.entries;
    std::vector<scene::Wound>& wounds = state_.scene.wounds;
    std::optional<std::size_t> index = entries.wound;
    if (!index && wounds.size() == 1 && wounds.front().photo.empty())
        index = 0; // replaces the default wound
    if (!index && !has_room_for_wound())
        return;
    if (!index) {
        index = wounds.size();
        wounds.push_back(next_wound(state_.scene));
    }
    scene::Wound& wound = wounds.at(*index);
    wound.photo = entries.photo;
    wound.mask.clear();
    wound.segmentation = {};
    if (entries.rectangle)
        wound.segmentation.rect = cv::Rect(*entries.rectangle);
    state_.selected = index;
}

void DemoWindow::save_scene(std::filesystem::path file)
{
    if (file.extension().empty())
        file += ".json";
    attempt([&] {
        scene::save_scene(file, state_.scene);
        on_disk_ = state_.scene;
        state_.scene_file = file;
        state_.wishes.quit = state_.entries.quit_when_saved;
        state_.notices.say(fmt::format("Saved {}", file.string()), now_s());
    });
}

cv::Mat3b DemoWindow::picture_of(double day, const stage::DrawOptions& options)
{
    picture_ = VK_NULL_HANDLE; // drawing another size may free the image
    const head::Camera camera = stage_->loaded().camera();
    cv::Mat3b picture = stage::draw(*renderer_, *stage_, {day, "", camera, ""}, options).picture;
    if (!compared_)
        return picture;
    const cv::Mat3b right =
        stage::draw(*renderer_, *compared_, {compared_day(day), "", camera, ""}, options).picture;
    const int divider = int(std::lround(state_.divider * picture.cols));
    right.colRange(divider, right.cols).copyTo(picture.colRange(divider, picture.cols));
    return picture;
}

void DemoWindow::save_picture(std::filesystem::path file)
{
    if (file.extension().empty())
        file += ".png";
    attempt([&] {
        stage::DrawOptions options;
        options.size = {std::uint32_t(state_.entries.size[0]), std::uint32_t(state_.entries.size[1])};
        base::write_png(file, picture_of(state_.playback.day, options));
        state_.notices.say(fmt::format("Saved {}", file.string()), now_s());
    });
    settle_ = 2;
}

void DemoWindow::start_film(std::filesystem::path file)
{
    if (file.extension().empty())
        file += ".mp4";
    attempt([&] {
        const DemoState::Entries& entries = state_.entries;
        Recording recording;
        recording.file = file;
        recording.options.size = {std::uint32_t(entries.size[0]), std::uint32_t(entries.size[1])};
        recording.pictures =
            std::max<std::size_t>(2, std::size_t(entries.seconds * entries.frames_per_second));
        recording.film =
            std::make_unique<base::Film>(file, recording.options.size, entries.frames_per_second);
        recording_ = std::move(recording);
        state_.playback.playing = false;
        state_.dialog = Dialog::Recording;
    });
}

/// Records one frame of the film per step, so that the window stays responsive.
void DemoWindow::record_picture()
{
    const auto end = [&](const std::string& notice) {
        recording_.reset();
        state_.dialog = Dialog::None;
        if (!notice.empty())
            state_.notices.say(notice, now_s());
        settle_ = 2;
    };
    if (std::exchange(state_.wishes.stop_film, false)) {
        end("Recording stopped; no film was written");
        return;
    }
    try {
        Recording& now = *recording_;
        const double day = state_.playback.axis.day_at(double(now.next) / double(now.pictures - 1));
        const cv::Mat3b picture = picture_of(day, now.options);
        now.film->add(picture);
        cv::Mat3b preview;
        cv::resize(picture, preview, {480, std::max(1, 480 * picture.rows / picture.cols)}, 0, 0,
                   cv::INTER_AREA);
        show_in_dialog(preview);
        state_.entries.pixels = {preview.cols, preview.rows};
        state_.recorded = double(++now.next) / double(now.pictures);
        if (now.next < now.pictures)
            return;
        now.film->finish();
        end(fmt::format("Saved {}", now.file.string()));
    } catch (const base::InputError& error) {
        end("");
        state_.notices.fail(error.what());
    }
}

} // namespace demo_command
