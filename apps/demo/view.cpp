#include <algorithm>
#include <cmath>
#include <imgui.h>

#include "apps/demo/camera_moves.hpp"
#include "apps/demo/ui.hpp"

namespace demo_command {
namespace {

constexpr ImU32 accent = IM_COL32(237, 140, 115, 255), pale = IM_COL32(255, 255, 255, 200),
                shade = IM_COL32(0, 0, 0, 130), sun = IM_COL32(255, 214, 120, 255);

ImVec2 to_screen(const DemoState& state, const glm::dvec2& at)
{
    return {state.view.left + float(at.x) * state.view.width,
            state.view.top + float(at.y) * state.view.height};
}

glm::dvec2 pointer(const DemoState& state)
{
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    return {(mouse.x - state.view.left) / std::max(state.view.width, 1.0f),
            (mouse.y - state.view.top) / std::max(state.view.height, 1.0f)};
}

bool near(const DemoState& state, const glm::dvec2& at, float units)
{
    const ImVec2 place = to_screen(state, at), mouse = ImGui::GetIO().MousePos;
    return std::hypot(place.x - mouse.x, place.y - mouse.y) < units * state.scale;
}

/// Symbol of the first light: its direction, drawn on a ball around the middle of the head.
struct Sun
{
    glm::dvec2 at{.5};
    bool in_front = true;
};
std::optional<Sun> sun_of(const DemoState& state)
{
    if (state.scene.lights.empty())
        return std::nullopt;
    const double azimuth = glm::radians(state.scene.lights.front().from.azimuth_deg),
                 elevation = glm::radians(state.scene.lights.front().from.elevation_deg);
    const glm::dvec3 towards(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                             std::cos(azimuth) * std::cos(elevation));
    const glm::dvec3 back = glm::normalize(state.stage.sight.eye() - state.stage.head_middle);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back)),
                     up = glm::cross(back, right);
    const double ball = .44 * state.view.height;
    return Sun{{.5 + glm::dot(towards, right) * ball / state.view.width,
                .5 - glm::dot(towards, up) * ball / state.view.height},
               glm::dot(towards, back) >= 0};
}

const head::Anchor* selected_anchor(const DemoState& state)
{
    for (std::size_t i = 0; i < state.stage.anchors.size(); ++i)
        if (state.selected && state.stage.scene_wounds[i] == *state.selected)
            return &state.stage.anchors[i]; // the first part of the wound; the scene sets its place
    return nullptr;
}

std::optional<std::size_t> wound_under(const DemoState& state, const glm::dvec2& at)
{
    for (std::size_t i = state.stage.anchors.size(); i-- > 0;)
        if (const auto outline = outline_of(state.stage.anchors[i], state.stage.sight);
            outline && inside(*outline, at))
            return state.stage.scene_wounds[i];
    return std::nullopt;
}

Drag left_drag(DemoState& state, const glm::dvec2& at)
{
    if (ImGui::GetIO().KeyShift)
        return Drag::Pan;
    if (state.compare != Compare::Nothing &&
        std::abs(at.x - state.divider) * state.view.width < 7 * state.scale)
        return Drag::Divider;
    if (const head::Anchor* anchor = selected_anchor(state))
        if (const auto outline = outline_of(*anchor, state.stage.sight); outline && outline->facing) {
            if (near(state, outline->width_handle, 9))
                return Drag::Width;
            if (near(state, outline->roll_handle, 9))
                return Drag::Roll;
        }
    if (const auto light = sun_of(state); light && near(state, light->at, 12))
        return Drag::Light;
    if (const auto wound = wound_under(state, at)) {
        state.selected = wound;
        state.mouse.on_wound = true;
        if (const head::Anchor* anchor = selected_anchor(state))
            if (const auto centre = state.stage.sight.project(anchor->centre))
                state.mouse.grip = *centre - at;
        return Drag::Wound;
    }
    return Drag::Turn;
}

void continue_drag(DemoState& state, const glm::dvec2& at)
{
    const ImVec2 by = ImGui::GetIO().MouseDelta;
    state.mouse.travelled += std::abs(by.x) + std::abs(by.y);
    const bool moved = state.mouse.travelled > 4 * state.scale;
    const double height = std::max(state.view.height, 1.0f), degrees = 180 / height;
    const head::Anchor* anchor = selected_anchor(state);
    scene::Wound* wound = anchor && *state.selected < state.scene.wounds.size()
                              ? &state.scene.wounds[*state.selected]
                              : nullptr;
    if (!moved || (by.x == 0 && by.y == 0))
        return;
    switch (state.mouse.drag) {
    case Drag::Turn:
        state.scene.camera = orbit(state.scene.camera, -by.x * degrees, by.y * degrees);
        break;
    case Drag::Pan:
        state.scene.camera =
            pan(state.scene.camera, by.x / height, by.y / height, state.stage.camera_distance_m);
        break;
    case Drag::Light:
        if (!state.scene.lights.empty())
            turn(state.scene.lights.front().from, by.x * degrees, -by.y * degrees);
        break;
    case Drag::Divider:
        state.divider = std::clamp(at.x, .02, .98);
        break;
    case Drag::Wound:
        state.wishes.move_to = at + state.mouse.grip;
        break;
    case Drag::Width:
        if (wound)
            wound->width_mm = dragged_width_mm(*anchor, state.stage.sight, at, wound->width_mm);
        break;
    case Drag::Roll:
        if (wound)
            wound->roll_deg = dragged_roll_deg(*anchor, state.stage.sight, at, wound->roll_deg);
        break;
    case Drag::None:
        break;
    }
}

void handle_mouse(DemoState& state)
{
    const glm::dvec2 at = pointer(state);
    if (ImGui::IsItemActivated()) {
        state.mouse = {};
        state.mouse.drag = ImGui::IsMouseDown(ImGuiMouseButton_Right)    ? Drag::Light
                           : ImGui::IsMouseDown(ImGuiMouseButton_Middle) ? Drag::Pan
                                                                         : left_drag(state, at);
    } else if (ImGui::IsItemActive()) {
        continue_drag(state, at);
    } else if (state.mouse.drag != Drag::None) {
        continue_drag(state, at); // the mouse may have moved before the release in this frame
        const bool clicked = state.mouse.travelled <= 4 * state.scale && state.mouse.drag == Drag::Turn;
        if (clicked)
            state.wishes.wound_at = at;
        state.mouse = {};
    }
    if (ImGui::IsItemHovered() && ImGui::GetIO().MouseWheel != 0)
        state.scene.camera = zoom(state.scene.camera, std::pow(1.14, double(ImGui::GetIO().MouseWheel)),
                                  state.stage.camera_distance_m);
}

void draw_sun(const DemoState& state, ImDrawList& list)
{
    const auto light = sun_of(state);
    if (!light)
        return;
    const ImVec2 at = to_screen(state, light->at);
    const float size = 6 * state.scale;
    const ImU32 color = light->in_front ? sun : IM_COL32(255, 214, 120, 110);
    list.AddCircleFilled(at, size + 2, shade);
    list.AddCircleFilled(at, size, color);
    for (int i = 0; i < 8; ++i) {
        const float angle = float(i) * .785398f;
        const ImVec2 ray(std::cos(angle), std::sin(angle));
        list.AddLine({at.x + ray.x * size * 1.4f, at.y + ray.y * size * 1.4f},
                     {at.x + ray.x * size * 1.9f, at.y + ray.y * size * 1.9f}, color, 1.5f * state.scale);
    }
    if (state.mouse.drag == Drag::Light)
        list.AddCircle(to_screen(state, {.5, .5}), .44f * state.view.height, IM_COL32(255, 214, 120, 60), 96);
}

void draw_selection(const DemoState& state, ImDrawList& list)
{
    const head::Anchor* anchor = selected_anchor(state);
    const auto outline = anchor ? outline_of(*anchor, state.stage.sight) : std::nullopt;
    if (!outline || !outline->facing)
        return;
    std::vector<ImVec2> ring;
    for (const glm::dvec2& corner : outline->ring)
        ring.push_back(to_screen(state, corner));
    list.AddPolyline(ring.data(), int(ring.size()), pale, ImDrawFlags_Closed, 1.5f * state.scale);
    const ImVec2 roll = to_screen(state, outline->roll_handle),
                 width = to_screen(state, outline->width_handle), top = ring[ring.size() / 4];
    list.AddLine(top, roll, pale, 1.5f * state.scale);
    const float size = 5 * state.scale;
    list.AddCircleFilled(roll, size + 1, shade);
    list.AddCircleFilled(roll, size, accent);
    list.AddRectFilled({width.x - size - 1, width.y - size - 1}, {width.x + size + 1, width.y + size + 1},
                       shade);
    list.AddRectFilled({width.x - size, width.y - size}, {width.x + size, width.y + size}, accent);
}

void label(const DemoState& state, ImDrawList& list, const char* text, float x, bool right_of_it)
{
    const ImVec2 size = ImGui::CalcTextSize(text);
    const float gap = 8 * state.scale, left = right_of_it ? x + gap : x - gap - size.x,
                top = state.view.top + gap;
    list.AddRectFilled({left - 6, top - 3}, {left + size.x + 6, top + size.y + 3}, shade, 4);
    list.AddText({left, top}, pale, text);
}

void draw_divider(const DemoState& state, ImDrawList& list)
{
    if (state.compare == Compare::Nothing)
        return;
    const float x = state.view.left + float(state.divider) * state.view.width;
    const float middle = state.view.top + state.view.height / 2, size = 9 * state.scale;
    list.AddLine({x, state.view.top}, {x, state.view.top + state.view.height}, pale, 1.5f * state.scale);
    list.AddCircleFilled({x, middle}, size, pale);
    list.AddTriangleFilled({x - size * .7f, middle}, {x - size * .2f, middle - size * .4f},
                           {x - size * .2f, middle + size * .4f}, IM_COL32(40, 40, 44, 255));
    list.AddTriangleFilled({x + size * .7f, middle}, {x + size * .2f, middle + size * .4f},
                           {x + size * .2f, middle - size * .4f}, IM_COL32(40, 40, 44, 255));
    const bool published = is_published(state.scene);
    const char *left = "", *right = "";
    switch (state.compare) {
    case Compare::Mode:
        left = published ? "as published" : "corrected";
        right = published ? "corrected" : "as published";
        break;
    case Compare::Day0:
        left = "today";
        right = "day 0";
        break;
    case Compare::Kept:
        left = "present settings";
        right = "kept settings";
        break;
    case Compare::Nothing:
        break;
    }
    label(state, list, left, x, false);
    label(state, list, right, x, true);
}

} // namespace

void draw_view(DemoState& state)
{
    const Rectangle& view = state.view;
    ImGui::SetNextWindowPos({view.left, view.top});
    ImGui::SetNextWindowSize({view.width, view.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::Begin("view", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    ImGui::InvisibleButton("picture", {std::max(view.width, 1.0f), std::max(view.height, 1.0f)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    handle_mouse(state);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (!state.loading && state.dialog != Dialog::Recording) { // no picture while recording
        draw_sun(state, list);
        draw_selection(state, list);
        draw_divider(state, list);
    }
    const char* busy = state.loading         ? "Reading the head ..."
                       : state.stage.pending ? "Preparing ..."
                                             : nullptr;
    if (busy)
        label(state, list, busy, view.left, true);
    ImGui::End();
    ImGui::PopStyleVar(2);
}

} // namespace demo_command
