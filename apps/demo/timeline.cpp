#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

#include "apps/demo/ui.hpp"
#include "wound/healing/healing.hpp"
#include "wound/healing/timeline.hpp"

namespace demo_command {
namespace {

/// Colour of a phase: from fresh blood to the pale scar.
ImU32 color_of(std::size_t phase, std::size_t count)
{
    constexpr std::array<ImU32, 5> course{IM_COL32(112, 32, 32, 255), IM_COL32(150, 74, 44, 255),
                                          IM_COL32(164, 60, 62, 255), IM_COL32(176, 92, 92, 255),
                                          IM_COL32(150, 112, 108, 255)};
    return count < 2 ? course[2] : course[phase + 1 == count ? 4 : std::min<std::size_t>(phase, 3)];
}

const wound::Healing& shown_healing(const DemoState& state)
{
    static const wound::Healing none;
    const std::vector<scene::Wound>& wounds = state.scene.wounds;
    return wounds.empty() ? none : wounds[std::min(state.selected.value_or(0), wounds.size() - 1)].healing;
}

/// Draws the name between `left` and `right` if it fits.
void name_phase(ImDrawList& list, const char* name, float left, float right, float top)
{
    const ImVec2 size = ImGui::CalcTextSize(name);
    if (size.x + 8 < right - left)
        list.AddText({left + (right - left - size.x) / 2, top}, IM_COL32(255, 240, 236, 230), name);
}

void draw_track(DemoState& state, ImVec2 corner, float width, float height)
{
    ImDrawList& list = *ImGui::GetWindowDrawList();
    Playback& playback = state.playback;
    const auto x_of = [&](double day) { return corner.x + float(playback.axis.fraction_of(day)) * width; };
    const float bottom = corner.y + height, text = ImGui::GetTextLineHeight();
    const std::vector<wound::TimelinePhase> phases =
        wound::timeline(shown_healing(state), playback.axis.last_day(), 2).phases;
    list.AddRectFilled(corner, {corner.x + width, bottom}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    for (std::size_t i = 0; i < phases.size() && !state.scene.wounds.empty(); ++i) {
        const float left = x_of(phases[i].first_day), right = x_of(phases[i].last_day);
        list.AddRectFilled({left, corner.y}, {right, bottom}, color_of(i, phases.size()));
        name_phase(list, phases[i].name, left, right, corner.y + (height - text) / 2);
        if (ImGui::IsItemHovered() && ImGui::IsMouseHoveringRect({left, corner.y}, {right, bottom}))
            ImGui::SetTooltip("%s, day %.0f to %.0f", phases[i].name, phases[i].first_day,
                              phases[i].last_day);
    }
    const auto room = std::size_t(std::max(4.0f, width / (52 * state.scale)));
    float free = corner.x - 1e3f;
    for (const TimelineAxis::Tick& tick : playback.axis.ticks(room)) {
        const float x = x_of(tick.day), size = ImGui::CalcTextSize(tick.label.c_str()).x;
        const float left = std::clamp(x - size / 2, corner.x, corner.x + width - size);
        list.AddLine({x, bottom}, {x, bottom + 4 * state.scale}, IM_COL32(150, 152, 156, 255));
        if (left < free)
            continue;
        list.AddText({left, bottom + 4 * state.scale}, IM_COL32(150, 152, 156, 255), tick.label.c_str());
        free = left + size + 6 * state.scale;
    }
    const float now = x_of(playback.day);
    list.AddRectFilled({now - 2 * state.scale, corner.y - 4 * state.scale},
                       {now + 2 * state.scale, bottom + 2}, IM_COL32(255, 255, 255, 255), 2);
}

void scrub(DemoState& state, float left, float width)
{
    if (!ImGui::IsItemActive())
        return;
    state.playback.playing = false;
    state.playback.seek(state.playback.axis.day_at((ImGui::GetIO().MousePos.x - left) / width));
}

std::string day_text(const DemoState& state)
{
    const double day = state.playback.day, closure = state.playback.axis.closure_day();
    std::string text = fmt::format("day {:.1f}", day);
    if (day >= closure)
        text += fmt::format("   scar, {:.1f} months", (day - closure) / 30.4);
    else if (!state.scene.wounds.empty())
        text += fmt::format("   {:.0f} % open", 100 * wound::unhealed_ratio(shown_healing(state).curve, day));
    return text;
}

} // namespace

void draw_timeline(DemoState& state)
{
    Playback& playback = state.playback;
    if (ImGui::Button(playback.playing ? "Pause" : "Play", {66 * state.scale, 0}))
        playback.toggle();
    ImGui::SameLine();
    ImGui::SetNextItemWidth(112 * state.scale);
    constexpr std::array speeds{.5, 1.0, 2.0, 3.0, 5.0, 10.0};
    if (ImGui::BeginCombo("##speed", fmt::format("{:g} days/s", playback.days_per_second).c_str())) {
        for (const double speed : speeds)
            if (ImGui::Selectable(fmt::format("{:g} days/s", speed).c_str(),
                                  speed == playback.days_per_second))
                playback.days_per_second = speed;
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const std::string day = day_text(state);
    const bool fits = ImGui::CalcTextSize(day.c_str()).x <= ImGui::GetContentRegionAvail().x;
    ImGui::TextUnformatted(fits ? day.c_str() : day.substr(0, day.find("   ")).c_str());

    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f), height = 22 * state.scale;
    ImGui::InvisibleButton("track", {width, height + ImGui::GetTextLineHeight()});
    scrub(state, corner.x, width);
    state.timeline = {corner.x, corner.y, width, height};
    draw_track(state, corner, width, height);
}

} // namespace demo_command
