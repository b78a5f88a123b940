// The demo's keyboard shortcuts and the help page: one table for both.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "apps/demo/ui.hpp"

namespace demo_command {
namespace {

struct Shortcut
{
    int key;
    bool control, shift;
    const char* keys; // for the help page; null: not listed
    const char* does;
    void (*act)(DemoState&);
};

void step_days(DemoState& state, double days)
{
    state.playback.playing = false;
    state.playback.seek(state.playback.day + days);
}

void change_speed(DemoState& state, double factor)
{
    state.playback.days_per_second = std::clamp(state.playback.days_per_second * factor, .25, 32.0);
}

void look_from(DemoState& state, double azimuth_deg)
{
    state.scene.camera.from = {azimuth_deg, 0};
}

const Shortcut shortcuts[] = {
    {GLFW_KEY_SPACE, false, false, "Space", "play or pause", [](DemoState& s) { s.playback.toggle(); }},
    {GLFW_KEY_RIGHT, false, false, "Right, Left", "next day, previous day",
     [](DemoState& s) { step_days(s, 1); }},
    {GLFW_KEY_LEFT, false, false, nullptr, nullptr, [](DemoState& s) { step_days(s, -1); }},
    {GLFW_KEY_RIGHT, false, true, "Shift+Right, Shift+Left", "a week on, a week back",
     [](DemoState& s) { step_days(s, 7); }},
    {GLFW_KEY_LEFT, false, true, nullptr, nullptr, [](DemoState& s) { step_days(s, -7); }},
    {GLFW_KEY_UP, false, false, "Up, Down", "faster, slower playback",
     [](DemoState& s) { change_speed(s, 2); }},
    {GLFW_KEY_DOWN, false, false, nullptr, nullptr, [](DemoState& s) { change_speed(s, .5); }},
    {GLFW_KEY_0, false, false, "0", "go to day 0", [](DemoState& s) { step_days(s, -1e6); }},
    {GLFW_KEY_DELETE, false, false, "Delete", "delete the selected wound", delete_selected},
    {GLFW_KEY_BACKSPACE, false, false, nullptr, nullptr, delete_selected},
    {GLFW_KEY_P, false, false, "P", "switch published / corrected",
     [](DemoState& s) {
         const bool published = is_published(s.scene);
         if (!published)
             s.mended = s.scene;
         set_published(s.scene, !published, s.mended);
     }},
    {GLFW_KEY_C, false, false, "C", "split view: published beside corrected",
     [](DemoState& s) { s.compare = s.compare == Compare::Nothing ? Compare::Mode : Compare::Nothing; }},
    {GLFW_KEY_HOME, false, false, "Home", "reset the camera",
     [](DemoState& s) { s.scene.camera = scene::Camera{}; }},
    {GLFW_KEY_1, false, false, "1, 2, 3", "look from the left, the front, the right",
     [](DemoState& s) { look_from(s, -80); }},
    {GLFW_KEY_2, false, false, nullptr, nullptr, [](DemoState& s) { look_from(s, 0); }},
    {GLFW_KEY_3, false, false, nullptr, nullptr, [](DemoState& s) { look_from(s, 80); }},
    {GLFW_KEY_TAB, false, false, "Tab", "show or hide the panels",
     [](DemoState& s) { s.panels = !s.panels; }},
    {GLFW_KEY_Z, true, false, "Ctrl+Z, Ctrl+Shift+Z", "undo, redo",
     [](DemoState& s) { s.wishes.undo = true; }},
    {GLFW_KEY_Z, true, true, nullptr, nullptr, [](DemoState& s) { s.wishes.redo = true; }},
    {GLFW_KEY_Y, true, false, nullptr, nullptr, [](DemoState& s) { s.wishes.redo = true; }},
    {GLFW_KEY_O, true, false, "Ctrl+O", "open a scene, head or photo",
     [](DemoState& s) { open_dialog(s, Dialog::Open); }},
    {GLFW_KEY_S, true, false, "Ctrl+S", "save the scene",
     [](DemoState& s) { open_dialog(s, Dialog::SaveScene); }},
    {GLFW_KEY_P, true, false, "Ctrl+P", "save a picture",
     [](DemoState& s) { open_dialog(s, Dialog::SavePicture); }},
    {GLFW_KEY_R, true, false, "Ctrl+R", "record a film", [](DemoState& s) { open_dialog(s, Dialog::Film); }},
    {GLFW_KEY_Q, true, false, "Ctrl+Q", "quit", [](DemoState& s) { s.wishes.quit = true; }},
    {GLFW_KEY_F1, false, false, "F1", "this page", [](DemoState& s) { open_dialog(s, Dialog::Help); }},
    {GLFW_KEY_ESCAPE, false, false, "Esc", "close a dialog; deselect the wound",
     [](DemoState& s) { s.selected.reset(); }},
};

constexpr std::array<std::array<const char*, 2>, 8> gestures{{
    {"Drag the head", "turn it"},
    {"Middle button, Shift+drag", "move it in the picture"},
    {"Wheel", "zoom"},
    {"Right button, or the sun", "drag the light"},
    {"Click on skin", "a new wound there"},
    {"Click on a wound", "select it"},
    {"Drag a wound, its handles", "move it; width and roll"},
    {"Drop a file on the window", "photo, head (.glb) or scene (.json)"},
}};

} // namespace

void press(DemoState& state, const window::KeyPress& key, bool typing)
{
    if (state.dialog != Dialog::None) {
        if (state.dialog == Dialog::Recording)
            state.wishes.stop_film = key.key == GLFW_KEY_ESCAPE;
        else if (key.key == GLFW_KEY_Q && key.control)
            state.wishes.quit = true;
        else if (key.key == GLFW_KEY_ESCAPE || (key.key == GLFW_KEY_F1 && state.dialog == Dialog::Help))
            state.dialog = Dialog::None;
        return;
    }
    if (typing && !key.control)
        return;
    for (const Shortcut& shortcut : shortcuts)
        if (shortcut.key == key.key && shortcut.control == key.control && shortcut.shift == key.shift &&
            !key.alt) {
            shortcut.act(state);
            return;
        }
}

void draw_help(DemoState& state)
{
    const auto row = [&](const char* what, const char* does) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(what);
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", does);
    };
    if (ImGui::BeginTable("help", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const auto& [what, does] : gestures)
            row(what, does);
        for (const Shortcut& shortcut : shortcuts)
            if (shortcut.keys)
                row(shortcut.keys, shortcut.does);
        ImGui::EndTable();
    }
    ImGui::TextDisabled("Drawn by %s", state.device.c_str());
}

} // namespace demo_command
