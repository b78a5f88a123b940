// Times of the last frame: a stacked bar of its passes, and whether each pass ran, was skipped or culled.
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <imgui.h>

#include "apps/demo/ui.hpp"

namespace demo_command {
namespace {

constexpr std::array<ImU32, 8> colors{IM_COL32(214, 108, 88, 255),  IM_COL32(86, 148, 190, 255),
                                      IM_COL32(222, 176, 94, 255),  IM_COL32(110, 172, 124, 255),
                                      IM_COL32(164, 124, 190, 255), IM_COL32(92, 178, 176, 255),
                                      IM_COL32(202, 130, 160, 255), IM_COL32(150, 150, 120, 255)};

double cost_ms(const gpu::PassResult& pass)
{
    return pass.state == graph::PassState::Run ? pass.gpu_ms.value_or(pass.cpu_ms) : 0;
}

void draw_bar(const DemoState& state)
{
    double sum = 0;
    for (const gpu::PassResult& pass : state.passes)
        sum += cost_ms(pass);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = 14 * state.scale;
    list.AddRectFilled(corner, {corner.x + width, corner.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg),
                       3);
    float left = corner.x;
    for (std::size_t i = 0; i < state.passes.size(); ++i) {
        const float part = sum > 0 ? float(cost_ms(state.passes[i]) / sum) * width : 0;
        list.AddRectFilled({left, corner.y}, {left + part, corner.y + height}, colors[i % colors.size()]);
        left += part;
    }
    ImGui::Dummy({width, height});
}

const char* verb(graph::PassState state)
{
    return state == graph::PassState::Run ? "ran" : state == graph::PassState::Skipped ? "skipped" : "culled";
}

void draw_pass(const DemoState& state, std::size_t index)
{
    const gpu::PassResult& pass = state.passes[index];
    const bool ran = pass.state == graph::PassState::Run;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float size = ImGui::GetTextLineHeight() * .6f, down = ImGui::GetTextLineHeight() * .2f;
    ImGui::GetWindowDrawList()->AddRectFilled(
        {corner.x, corner.y + down}, {corner.x + size, corner.y + down + size},
        ran ? colors[index % colors.size()] : ImGui::GetColorU32(ImGuiCol_FrameBgHovered), 2);
    ImGui::Dummy({size, size});
    ImGui::SameLine();
    ImGui::TextUnformatted(pass.name.c_str());
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", verb(pass.state));
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", pass.reason.c_str());
    ImGui::TableNextColumn();
    if (ran)
        ImGui::Text("%.2f ms", cost_ms(pass));
}

} // namespace

void draw_timing(DemoState& state)
{
    draw_bar(state);
    if (ImGui::BeginTable("passes", 3)) {
        ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("state", ImGuiTableColumnFlags_WidthFixed);
        ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthFixed,
                                ImGui::CalcTextSize("0000.00 ms").x); // independent of the first row
        for (std::size_t i = 0; i < state.passes.size(); ++i)
            draw_pass(state, i);
        ImGui::EndTable();
    }
    ImGui::TextDisabled(
        "%s",
        fmt::format("last picture {:.1f} ms{}\n{}", state.frame_ms,
                    state.render_scale < 1 ? fmt::format(", at {:.0f} % size", 100 * state.render_scale) : "",
                    state.device)
            .c_str());
}

} // namespace demo_command
