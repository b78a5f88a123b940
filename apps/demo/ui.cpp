#include "apps/demo/ui.hpp"

#include <algorithm>
#include <imgui.h>

namespace demo_command {
namespace {

constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                          ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar;

void file_menu(DemoState& state)
{
    if (ImGui::MenuItem("Open scene, head or photo ...", "Ctrl+O"))
        open_dialog(state, Dialog::Open);
    ImGui::Separator();
    if (ImGui::MenuItem("Save scene ...", "Ctrl+S"))
        open_dialog(state, Dialog::SaveScene);
    if (ImGui::MenuItem("Save picture ...", "Ctrl+P"))
        open_dialog(state, Dialog::SavePicture);
    if (ImGui::MenuItem("Record film ...", "Ctrl+R"))
        open_dialog(state, Dialog::Film);
    ImGui::Separator();
    if (ImGui::MenuItem("Quit", "Ctrl+Q"))
        state.wishes.quit = true;
}

void edit_menu(DemoState& state)
{
    if (ImGui::MenuItem("Undo", "Ctrl+Z", false, state.can_undo))
        state.wishes.undo = true;
    if (ImGui::MenuItem("Redo", "Ctrl+Shift+Z", false, state.can_redo))
        state.wishes.redo = true;
    ImGui::Separator();
    if (ImGui::MenuItem("Delete wound", "Delete", false, state.selected.has_value()))
        delete_selected(state);
}

void view_menu(DemoState& state)
{
    ImGui::MenuItem("Panels", "Tab", &state.panels);
    if (ImGui::MenuItem("Reset camera", "Home"))
        state.scene.camera = scene::Camera{};
    ImGui::Separator();
    const auto compare = [&](const char* name, const char* key, Compare which, bool possible = true) {
        if (ImGui::MenuItem(name, key, state.compare == which, possible))
            state.compare = state.compare == which ? Compare::Nothing : which;
    };
    compare("Split: corrected | published", "C", Compare::Mode);
    compare("Split: today | day 0", nullptr, Compare::Day0);
    compare("Split: present settings | kept settings", nullptr, Compare::Kept, state.kept.has_value());
    if (ImGui::MenuItem("Keep these settings for comparison"))
        state.kept = state.scene;
}

float draw_menu(DemoState& state)
{
    float height = 0;
    if (!ImGui::BeginMainMenuBar())
        return height;
    const auto menu = [&](const char* name, void (*items)(DemoState&)) {
        if (ImGui::BeginMenu(name)) {
            items(state);
            ImGui::EndMenu();
        }
    };
    menu("File", file_menu);
    menu("Edit", edit_menu);
    menu("View", view_menu);
    menu("Help", [](DemoState& s) {
        if (ImGui::MenuItem("Mouse and keys", "F1"))
            open_dialog(s, Dialog::Help);
    });
    height = ImGui::GetWindowSize().y;
    ImGui::EndMainMenuBar();
    return height;
}

void draw_notice(DemoState& state, std::size_t index)
{
    const Notice& notice = state.notices.list()[index];
    ImGui::PushID(int(index));
    if (notice.error)
        ImGui::PushStyleColor(ImGuiCol_Text, {1, .62f, .52f, 1});
    ImGui::PushTextWrapPos(std::min(560 * state.scale, state.view.width - 90 * state.scale));
    ImGui::TextUnformatted(notice.text.c_str());
    ImGui::PopTextWrapPos();
    if (notice.error) {
        ImGui::PopStyleColor();
        ImGui::SameLine();
        if (ImGui::SmallButton("OK"))
            state.notices.dismiss(index);
    }
    ImGui::PopID();
}

void draw_notices(DemoState& state)
{
    if (state.notices.list().empty())
        return;
    const Rectangle& view = state.view;
    const float gap = 12 * state.scale;
    ImGui::SetNextWindowPos({view.left + gap, view.top + view.height - gap}, 0, {0, 1});
    ImGui::SetNextWindowBgAlpha(.88f);
    // No NoBringToFrontOnFocus here: it would put the notices behind the view.
    ImGui::Begin("notices", nullptr,
                 fixed_window | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
    for (std::size_t i = 0; i < state.notices.list().size(); ++i)
        draw_notice(state, i);
    ImGui::End();
}

void draw_fixed(const char* name, const Rectangle& place, void (*contents)(DemoState&), DemoState& state,
                ImGuiWindowFlags flags)
{
    ImGui::SetNextWindowPos({place.left, place.top});
    ImGui::SetNextWindowSize({place.width, place.height});
    if (ImGui::Begin(name, nullptr, fixed_window | ImGuiWindowFlags_NoBringToFrontOnFocus | flags))
        contents(state);
    ImGui::End();
}

} // namespace

void draw_demo(DemoState& state)
{
    const float menu = draw_menu(state);
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float panels = state.panels ? std::min(330 * state.scale, window.x / 2) : 0;
    const float timeline = std::min(92 * state.scale, window.y / 3);
    state.view = {0, menu, std::max(0.0f, window.x - panels), std::max(0.0f, window.y - menu - timeline)};
    state.timeline = {0, window.y - timeline, state.view.width, timeline};
    draw_view(state);
    draw_fixed("timeline", state.timeline, draw_timeline, state,
               ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    if (state.panels)
        draw_fixed("panels", {window.x - panels, menu, panels, window.y - menu}, draw_panels, state, 0);
    draw_notices(state);
    draw_dialogs(state);
    state.moving = state.mouse.drag != Drag::None ||
                   (ImGui::IsAnyItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left) &&
                    !ImGui::GetIO().WantTextInput);
}

void delete_selected(DemoState& state)
{
    if (state.selected && *state.selected < state.scene.wounds.size())
        state.scene.wounds.erase(state.scene.wounds.begin() + std::ptrdiff_t(*state.selected));
    state.selected.reset();
}

} // namespace demo_command
