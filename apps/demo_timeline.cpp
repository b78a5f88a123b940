#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

#include "apps/demo_ui.hpp"
#include "wound/healing.hpp"

namespace app {
namespace {

struct PhaseName
{
    double from, to; // days
    const char* name;
    ImU32 color;
};

/// After Singer & Clark 1999; the bed's colours follow the same course (wound/phases.hpp), which stretches
/// with the time to closure.
std::vector<PhaseName> phases_of(const TimelineAxis& axis)
{
    const double closure = axis.closure_day(), end = axis.last_day();
    if (!std::isfinite(closure) || closure >= end)
        return {{0, end, "open wound", IM_COL32(134, 50, 46, 255)}};
    const double early = std::min(2.5, .1 * closure), inflamed = std::min(5.0, .3 * closure);
    return {{0, early, "clot", IM_COL32(112, 32, 32, 255)},
            {early, inflamed, "inflammation", IM_COL32(150, 74, 44, 255)},
            {inflamed, closure, "granulation, new skin", IM_COL32(164, 70, 72, 255)},
            {closure, end, "scar", IM_COL32(150, 112, 108, 255)}};
}

/// On its stretch if it fits there.
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
    for (const PhaseName& phase : phases_of(playback.axis)) {
        list.AddRectFilled({x_of(phase.from), corner.y}, {x_of(phase.to), bottom}, phase.color);
        name_phase(list, phase.name, x_of(phase.from), x_of(phase.to), corner.y + (height - text) / 2);
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
    else if (!state.scene.wounds.empty()) {
        const std::size_t wound = std::min(state.selected.value_or(0), state.scene.wounds.size() - 1);
        text += fmt::format("   {:.0f} % open",
                            100 * wound::unhealed_ratio(state.scene.wounds[wound].healing.curve, day));
    }
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
    ImGui::TextUnformatted(day_text(state).c_str());

    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f), height = 22 * state.scale;
    ImGui::InvisibleButton("track", {width, height + ImGui::GetTextLineHeight()});
    scrub(state, corner.x, width);
    state.timeline = {corner.x, corner.y, width, height};
    draw_track(state, corner, width, height);
}

} // namespace app
