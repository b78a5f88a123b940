#include <algorithm>
#include <array>
#include <filesystem>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "apps/demo/ui.hpp"
#include "engine/window/ui_renderer.hpp"

namespace demo_command {
namespace {

/// Draws the confirm and cancel buttons; both close the dialog. Returns whether it was confirmed.
bool buttons(DemoState& state, const char* confirm, bool possible = true)
{
    ImGui::Spacing();
    ImGui::BeginDisabled(!possible);
    const bool confirmed = ImGui::Button(confirm, {120 * state.scale, 0});
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {90 * state.scale, 0}) || confirmed)
        state.dialog = Dialog::None;
    return confirmed;
}

/// A field for a file's name. Returns whether Enter was pressed, which confirms the dialog.
bool path_field(DemoState& state, const char* label)
{
    ImGui::SetNextItemWidth(460 * state.scale);
    if (ImGui::IsWindowAppearing())
        ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText(label, &state.entries.path, ImGuiInputTextFlags_EnterReturnsTrue);
    if (entered)
        state.dialog = Dialog::None;
    return entered;
}

bool exists(const std::string& path)
{
    std::error_code error;
    return std::filesystem::exists(path, error);
}

const char* save_or_replace(const std::string& path)
{
    return exists(path) ? "Replace" : "Save";
}

void size_field(DemoState& state)
{
    std::array<int, 2>& size = state.entries.size;
    ImGui::SetNextItemWidth(160 * state.scale);
    ImGui::InputInt2("pixels", size.data());
    for (int& side : size)
        side = std::clamp(side, 16, 16384);
    ImGui::SameLine();
    if (ImGui::SmallButton("as seen"))
        size = {std::max(16, int(state.view.width)), std::max(16, int(state.view.height))};
    ImGui::SameLine();
    if (ImGui::SmallButton("1080p"))
        size = {1920, 1080};
    ImGui::SameLine();
    if (ImGui::SmallButton("4K"))
        size = {3840, 2160};
}

void draw_open(DemoState& state)
{
    ImGui::TextDisabled("A scene (.json), a head (.glb, .gltf) or a photo of a wound (.png, .jpg).\n"
                        "Dropping the file on the window does the same.");
    const bool entered = path_field(state, "file");
    if (buttons(state, "Open", !state.entries.path.empty()) || entered)
        state.wishes.open = state.entries.path;
}

void draw_save_scene(DemoState& state)
{
    ImGui::TextDisabled("Head, wounds, light, camera and shading, as JSON; cicatrix capture can read it.");
    const bool entered = path_field(state, "file");
    if (buttons(state, save_or_replace(state.entries.path), !state.entries.path.empty()) || entered)
        state.wishes.save_scene = state.entries.path;
}

void note_split_view(const DemoState& state)
{
    if (state.compare != Compare::Nothing)
        ImGui::TextDisabled("Both sides of the split view, with the divider where it is now.");
}

void draw_save_picture(DemoState& state)
{
    ImGui::TextDisabled("The face from the present camera, on this day, without the controls.");
    note_split_view(state);
    const bool entered = path_field(state, "file");
    size_field(state);
    if (buttons(state, save_or_replace(state.entries.path), !state.entries.path.empty()) || entered)
        state.wishes.save_picture = state.entries.path;
}

void draw_film(DemoState& state)
{
    ImGui::TextDisabled("All days of the timeline, from the present camera.");
    note_split_view(state);
    const bool entered = path_field(state, "file");
    size_field(state);
    ImGui::SetNextItemWidth(160 * state.scale);
    ImGui::InputDouble("seconds", &state.entries.seconds, 0, 0, "%.1f");
    state.entries.seconds = std::clamp(state.entries.seconds, .2, 600.0);
    ImGui::SetNextItemWidth(160 * state.scale);
    ImGui::InputInt("pictures per second", &state.entries.frames_per_second, 0);
    state.entries.frames_per_second = std::clamp(state.entries.frames_per_second, 1, 120);
    if (buttons(state, save_or_replace(state.entries.path), !state.entries.path.empty()) || entered)
        state.wishes.film = state.entries.path;
}

void draw_recording(DemoState& state)
{
    if (state.entries.picture)
        ImGui::Image(
            window::UiRenderer::texture_id(*state.entries.picture),
            {float(state.entries.pixels[0]) * state.scale, float(state.entries.pixels[1]) * state.scale});
    ImGui::ProgressBar(float(state.recorded),
                       {std::max(320.0f, float(state.entries.pixels[0])) * state.scale, 0});
    if (ImGui::Button("Stop without saving"))
        state.wishes.stop_film = true;
}

/// The photograph, fitted into the dialog; a rectangle is drawn on it with the mouse.
void draw_photo(DemoState& state)
{
    DemoState::Entries& entries = state.entries;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float fit = std::min({.6f * window.x / float(entries.pixels[0]),
                                .6f * window.y / float(entries.pixels[1]), 3 * state.scale});
    const ImVec2 size(float(entries.pixels[0]) * fit, float(entries.pixels[1]) * fit);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    entries.shown = {corner.x, corner.y, size.x, size.y};
    ImGui::Image(window::UiRenderer::texture_id(*entries.picture), size);
    ImGui::SetCursorScreenPos(corner);
    ImGui::InvisibleButton("photo", size);
    const auto pixel = [&](const ImVec2& at) {
        return cv::Point2d(std::clamp((at.x - corner.x) / fit, 0.0f, float(entries.pixels[0])),
                           std::clamp((at.y - corner.y) / fit, 0.0f, float(entries.pixels[1])));
    };
    if (ImGui::IsItemActive()) {
        const cv::Rect2d drawn(pixel(ImGui::GetIO().MouseClickedPos[0]), pixel(ImGui::GetIO().MousePos));
        if (drawn.width * fit > 6 && drawn.height * fit > 6)
            entries.rectangle = drawn;
        else
            entries.rectangle.reset();
    }
    if (!entries.rectangle)
        return;
    const cv::Rect2d& r = *entries.rectangle;
    ImGui::GetWindowDrawList()->AddRect(
        {corner.x + float(r.x) * fit, corner.y + float(r.y) * fit},
        {corner.x + float(r.x + r.width) * fit, corner.y + float(r.y + r.height) * fit},
        IM_COL32(237, 140, 115, 255), 0, 0, 2 * state.scale);
}

void draw_area(DemoState& state)
{
    ImGui::TextDisabled("Draw a rectangle around the wound, with a little skin on every side.\n"
                        "Without one, the whole photo is searched for the wound.");
    if (state.entries.picture)
        draw_photo(state);
    const bool entered =
        ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false) && !ImGui::IsWindowAppearing();
    if (buttons(state, state.entries.rectangle ? "Use this area" : "Whole photo") || entered) {
        state.dialog = Dialog::None;
        state.wishes.use_photo = true;
    }
}

void draw_quit(DemoState& state)
{
    ImGui::TextUnformatted("The scene has edits that are not saved.");
    ImGui::Spacing();
    if (ImGui::Button("Save ...")) {
        open_dialog(state, Dialog::SaveScene);
        state.entries.quit_when_saved = true;
    }
    ImGui::SameLine();
    state.wishes.quit |= ImGui::Button("Quit without saving"); // may_close() allows it in this dialog
    ImGui::SameLine();
    if (ImGui::Button("Cancel"))
        state.dialog = Dialog::None;
}

struct DialogPage
{
    Dialog which;
    const char* title;
    void (*draw)(DemoState&);
};
constexpr std::array<DialogPage, 8> pages{{{Dialog::Recording, "Recording", draw_recording},
                                           {Dialog::Open, "Open", draw_open},
                                           {Dialog::SaveScene, "Save scene", draw_save_scene},
                                           {Dialog::SavePicture, "Save picture", draw_save_picture},
                                           {Dialog::Film, "Record film", draw_film},
                                           {Dialog::Area, "Wound in the photo", draw_area},
                                           {Dialog::Quit, "Quit", draw_quit},
                                           {Dialog::Help, "Mouse and keys", [](DemoState& state) {
                                                draw_help(state);
                                                if (ImGui::Button("Close"))
                                                    state.dialog = Dialog::None;
                                            }}}};

/// The file that the scene has, or a default name.
std::string suggested_path(const DemoState& state, Dialog dialog)
{
    const std::string stem = state.scene_file.empty() ? "cicatrix" : state.scene_file.stem().string();
    switch (dialog) {
    case Dialog::SaveScene:
        return state.scene_file.empty() ? "scene.json" : state.scene_file.string();
    case Dialog::SavePicture:
        return stem + ".png";
    case Dialog::Film:
        return stem + ".mp4";
    default:
        return {};
    }
}

} // namespace

void open_dialog(DemoState& state, Dialog dialog)
{
    state.dialog = dialog;
    state.entries.path = suggested_path(state, dialog);
    state.entries.quit_when_saved = false;
    if (dialog == Dialog::SavePicture || dialog == Dialog::Film)
        state.entries.size = {int(state.scene.size[0]), int(state.scene.size[1])};
}

void draw_dialogs(DemoState& state)
{
    const auto page = std::ranges::find(pages, state.dialog, &DialogPage::which);
    if (page == pages.end())
        return;
    if (!ImGui::IsPopupOpen(page->title))
        ImGui::OpenPopup(page->title);
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {.5f, .5f});
    if (ImGui::BeginPopupModal(page->title, nullptr,
                               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings))
    {
        page->draw(state);
        if (state.dialog != page->which)
            ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
    }
}

} // namespace demo_command
