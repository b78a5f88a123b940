// A slider for a number of the scene; label, range and format come from the field table.
#pragma once
#include <imgui.h>
#include <string_view>
#include <vector>

#include "scene/field_table.hpp"

namespace demo_command {

/// `name`: a field that has a slider.
template <typename Object>
void draw_slider(const std::vector<scene::Field<Object>>& fields, std::string_view name, Object& object)
{
    const scene::Field<Object>& field = scene::field_named(fields, name);
    const scene::Slider& slider = field.slider.value();
    ImGui::SliderScalar(slider.label.c_str(), ImGuiDataType_Double, &field.number(object), &slider.low,
                        &slider.high, slider.format,
                        ImGuiSliderFlags_AlwaysClamp |
                            (slider.logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
}

} // namespace demo_command
