#include "apps/demo_ui.hpp"

#include <algorithm>
#include <imgui.h>

namespace app {
namespace {

constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                          ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar |
                                          ImGuiWindowFlags_NoBringToFrontOnFocus;

float draw_menu(DemoState& state)
{
    float height = 0;
    if (ImGui::BeginMainMenuBar()) {
        if (ImGui::BeginMenu("File")) {
            if (ImGui::MenuItem("Quit", "Ctrl+Q"))
                state.wishes.quit = true;
            ImGui::EndMenu();
        }
        if (ImGui::BeginMenu("View")) {
            ImGui::MenuItem("Panels", "Tab", &state.panels);
            ImGui::EndMenu();
        }
        if (ImGui::BeginMenu("Help")) {
            ImGui::MenuItem("Keyboard and mouse", "F1", &state.help);
            ImGui::EndMenu();
        }
        height = ImGui::GetWindowSize().y;
        ImGui::EndMainMenuBar();
    }
    return height;
}

void draw_notices(DemoState& state)
{
    const Rectangle& view = state.view;
    ImGui::SetNextWindowPos({view.left + 12 * state.scale, view.top + view.height - 12 * state.scale}, 0,
                            {0, 1});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {view.width - 24 * state.scale, view.height});
    ImGui::SetNextWindowBgAlpha(.85f);
    if (state.notices.list().empty() ||
        !ImGui::Begin("notices", nullptr,
                      fixed_window | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing))
        return;
    for (std::size_t i = 0; i < state.notices.list().size(); ++i) {
        const Notice& notice = state.notices.list()[i];
        ImGui::PushID(int(i));
        ImGui::PushStyleColor(ImGuiCol_Text,
                              notice.error ? ImVec4(1, .6f, .5f, 1) : ImVec4(.89f, .89f, .88f, 1));
        ImGui::PushTextWrapPos(std::min(560 * state.scale, view.width - 90 * state.scale));
        ImGui::TextUnformatted(notice.text.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
        bool dismissed = false;
        if (notice.error) {
            ImGui::SameLine();
            dismissed = ImGui::SmallButton("OK");
        }
        ImGui::PopID();
        if (dismissed) {
            state.notices.dismiss(i);
            break;
        }
    }
    ImGui::End();
}

} // namespace

void draw_demo(DemoState& state)
{
    const float menu = draw_menu(state);
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float panels = state.panels ? std::min(340 * state.scale, window.x / 2) : 0;
    const float timeline = std::min(104 * state.scale, window.y / 3);
    state.view = {0, menu, window.x - panels, window.y - menu - timeline};
    state.timeline = {0, window.y - timeline, window.x - panels, timeline};
    draw_view(state);
    ImGui::SetNextWindowPos({state.timeline.left, state.timeline.top});
    ImGui::SetNextWindowSize({state.timeline.width, state.timeline.height});
    if (ImGui::Begin("timeline", nullptr, fixed_window | ImGuiWindowFlags_NoScrollbar))
        draw_timeline(state);
    ImGui::End();
    if (state.panels) {
        ImGui::SetNextWindowPos({window.x - panels, menu});
        ImGui::SetNextWindowSize({panels, window.y - menu});
        if (ImGui::Begin("panels", nullptr, fixed_window))
            draw_panels(state, {window.x - panels, menu, panels, window.y - menu});
        ImGui::End();
    }
    draw_notices(state);
    state.moving = ImGui::IsAnyItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left);
}

} // namespace app
