// Panels for skin, light, shading and comparison.
#include <algorithm>
#include <array>
#include <filesystem>
#include <imgui.h>

#include "apps/demo/field_slider.hpp"
#include "apps/demo/ui.hpp"

namespace demo_command {
namespace {

void draw_skin(DemoState& state)
{
    scene::Scene& scene = state.scene;
    if (ImGui::BeginCombo("tissue", std::filesystem::path(scene.tissue).filename().c_str())) {
        for (const char* name : {"light", "medium", "dark", "table1"})
            if (ImGui::Selectable(name, scene.tissue == name))
                scene.tissue = name;
        ImGui::EndCombo();
    }
    constexpr std::array<std::pair<optics::ReflectanceModel, const char*>, 6> models{
        {{optics::ReflectanceModel::Printed, "printed"},
         {optics::ReflectanceModel::Published, "published"},
         {optics::ReflectanceModel::Exponential, "exponential"},
         {optics::ReflectanceModel::TwoStreamPaper, "two-stream, paper"},
         {optics::ReflectanceModel::TwoStream, "two-stream"},
         {optics::ReflectanceModel::Calibrated, "calibrated"}}};
    const auto current = std::ranges::find(models, scene.reflectance_model,
                                           &std::pair<optics::ReflectanceModel, const char*>::first);
    if (ImGui::BeginCombo("reflectance", current == models.end() ? "" : current->second)) {
        for (const auto& [model, name] : models)
            if (ImGui::Selectable(name, model == scene.reflectance_model))
                scene.reflectance_model = model;
        ImGui::EndCombo();
    }
    draw_sliders(scene::scene_fields(), scene, scene::Section::Skin);
}

void draw_light(DemoState& state)
{
    for (std::size_t i = 0; i < state.scene.lights.size(); ++i) {
        scene::Light& light = state.scene.lights[i];
        ImGui::PushID(int(i));
        ImGui::TextDisabled(i == 0 ? "key light" : i == 1 ? "fill light" : "light %d", int(i) + 1);
        draw_sliders(scene::light_fields(), light);
        ImGui::PopID();
    }
    draw_sliders(scene::scene_fields(), state.scene, scene::Section::Light);
}

void draw_mode(DemoState& state)
{
    const bool published = is_published(state.scene);
    if (ImGui::RadioButton("corrected", !published) && published)
        set_published(state.scene, false, state.mended);
    ImGui::SameLine();
    if (ImGui::RadioButton("as published", published) && !published) {
        state.mended = state.scene;
        set_published(state.scene, true, state.mended);
    }
}

void draw_terms(optics::Shading& shading)
{
    ImGui::Checkbox("diffuse", &shading.lambert);
    ImGui::SameLine();
    bool translucent = shading.translucency && shading.transport == optics::Transport::Published;
    if (ImGui::Checkbox("translucency", &translucent)) {
        shading.translucency = translucent;
        shading.transport = translucent ? optics::Transport::Published : optics::skin_shading().transport;
    }
    ImGui::SameLine();
    ImGui::Checkbox("gloss", &shading.ward);
    ImGui::Checkbox("pores", &shading.normal_map);
    ImGui::SameLine();
    ImGui::Checkbox("shadow", &shading.shadow);
    ImGui::SameLine();
    bool ambient = shading.ambient != base::Color(0, 0, 0);
    if (ImGui::Checkbox("ambient", &ambient))
        shading.ambient = ambient ? optics::skin_shading().ambient : base::Color(0, 0, 0);
    draw_sliders(scene::shading_fields(), shading);
}

void draw_comparison(DemoState& state)
{
    const auto choice = [&](const char* name, Compare which) {
        if (ImGui::RadioButton(name, state.compare == which))
            state.compare = which;
    };
    choice("off", Compare::Nothing);
    ImGui::SameLine();
    choice("other mode", Compare::Mode);
    ImGui::SameLine();
    choice("day 0", Compare::Day0);
    if (state.kept) {
        ImGui::SameLine();
        choice("kept", Compare::Kept);
    }
    if (ImGui::Button("Keep these settings"))
        state.kept = state.scene;
}

} // namespace

void draw_looks(DemoState& state)
{
    if (ImGui::CollapsingHeader("Skin"))
        draw_skin(state);
    if (ImGui::CollapsingHeader("Light"))
        draw_light(state);
    if (ImGui::CollapsingHeader("Shading", ImGuiTreeNodeFlags_DefaultOpen)) {
        draw_mode(state);
        draw_terms(state.scene.shading);
    }
    if (ImGui::CollapsingHeader("Split view", ImGuiTreeNodeFlags_DefaultOpen))
        draw_comparison(state);
}

} // namespace demo_command
