#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

#include "apps/demo/field_slider.hpp"
#include "apps/demo/ui.hpp"
#include "wound/healing/healing.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace demo_command {
namespace {

std::string title_of(const scene::Wound& wound, std::size_t index)
{
    return fmt::format("{}  {}", index + 1,
                       wound.photo.empty() ? wound.kind : wound.photo.filename().string());
}

void draw_list(DemoState& state)
{
    if (state.scene.wounds.empty())
        ImGui::TextDisabled("Click on the skin to put a wound there.");
    for (std::size_t i = 0; i < state.scene.wounds.size(); ++i) {
        ImGui::PushID(int(i));
        if (ImGui::Selectable(title_of(state.scene.wounds[i], i).c_str(), state.selected == i))
            state.selected = i;
        ImGui::PopID();
    }
}

void draw_wound(DemoState& state, scene::Wound& wound)
{
    draw_sliders(scene::wound_fields(), wound);
    if (wound.photo.empty()) {
        if (ImGui::BeginCombo("kind", wound.kind.c_str())) {
            for (const std::string& kind : wound::kind_names())
                if (ImGui::Selectable(kind.c_str(), wound.kind == kind))
                    wound.kind = kind;
            ImGui::EndCombo();
        }
        if (ImGui::Button("Another shape"))
            ++wound.seed;
    } else if (ImGui::Button("Area in the photo ..."))
        state.wishes.photo_area = state.selected;
    ImGui::SameLine();
    if (ImGui::Button("Delete"))
        delete_selected(state);
}

/// Plots the area of the open wound and the area inside its border over the days, and marks today.
void draw_curve(const DemoState& state, const wound::Healing& healing)
{
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = 92 * state.scale;
    const double days = state.playback.axis.even_until();
    list.AddRectFilled(corner, {corner.x + width, corner.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg),
                       3);
    const float pad = 6 * state.scale;
    const auto place = [&](double day, double ratio) {
        return ImVec2(corner.x + pad + float(day / days) * (width - 2 * pad),
                      corner.y + pad + float(1 - ratio / wound::largest_drawn_ratio) * (height - 2 * pad));
    };
    for (const double ratio : {0.0, .5, 1.0})
        list.AddLine(place(0, ratio), place(days, ratio), IM_COL32(255, 255, 255, 24));
    std::vector<ImVec2> open, border;
    for (int i = 0; i <= 96; ++i) {
        const wound::HealingState at = wound::healing_at(healing, days * i / 96);
        open.push_back(place(at.day, std::min(at.unhealed_ratio, wound::largest_drawn_ratio)));
        border.push_back(place(at.day, std::min(at.border_ratio, wound::largest_drawn_ratio)));
    }
    list.AddPolyline(border.data(), int(border.size()), IM_COL32(200, 160, 140, 170), 0, 1.2f * state.scale);
    list.AddPolyline(open.data(), int(open.size()), IM_COL32(237, 110, 92, 255), 0, 2 * state.scale);
    if (state.playback.day <= days) {
        const wound::HealingState now = wound::healing_at(healing, state.playback.day);
        list.AddLine(place(now.day, 0), place(now.day, wound::largest_drawn_ratio),
                     IM_COL32(255, 255, 255, 110));
        list.AddCircleFilled(place(now.day, std::min(now.unhealed_ratio, wound::largest_drawn_ratio)),
                             3.5f * state.scale, IM_COL32(255, 255, 255, 255));
    }
    const std::string closure =
        std::isfinite(wound::closure_day(healing.curve))
            ? fmt::format("half on day {:.0f}, closed on day {:.0f}", wound::half_time(healing.curve),
                          wound::closure_day(healing.curve))
            : "does not close";
    const ImVec2 size = ImGui::CalcTextSize(closure.c_str());
    list.AddText({corner.x + width - pad - size.x, corner.y + pad}, IM_COL32(190, 190, 190, 255),
                 closure.c_str());
    ImGui::Dummy({width, height});
}

void draw_healing(DemoState& state, wound::Healing& healing)
{
    draw_curve(state, healing);
    ImGui::TextDisabled("area: open wound, inside its border");
    const bool face = healing.model == wound::HealingModel::Face;
    if (ImGui::BeginCombo("closes", face ? "by new skin" : "by contraction")) {
        if (ImGui::Selectable("by new skin", face))
            healing.model = wound::HealingModel::Face;
        if (ImGui::Selectable("by contraction", !face))
            healing.model = wound::HealingModel::Contraction;
        ImGui::EndCombo();
    }
    if (!ImGui::TreeNode("Parameters"))
        return;
    draw_sliders(scene::healing_fields(), healing);
    ImGui::TreePop();
}

bool section(const char* name, bool open)
{
    return ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

} // namespace

void draw_panels(DemoState& state)
{
    ImGui::PushItemWidth(-82 * state.scale);
    std::vector<scene::Wound>& wounds = state.scene.wounds;
    if (state.selected && *state.selected >= wounds.size())
        state.selected.reset();
    if (section("Wounds", true)) {
        draw_list(state);
        if (state.selected) {
            scene::Wound edited = wounds[*state.selected];
            const std::size_t index = *state.selected;
            draw_wound(state, edited);
            if (state.selected) // the wound was not deleted
                wounds[index] = edited;
        }
    }
    if (!wounds.empty() && section("Healing", true))
        draw_healing(state, wounds[std::min(state.selected.value_or(0), wounds.size() - 1)].healing);
    draw_looks(state);
    if (section("Passes", true))
        draw_timing(state);
    ImGui::PopItemWidth();
}

} // namespace demo_command
