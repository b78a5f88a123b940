// Sliders for the numbers of a scene. Which fields have one, its label, range, format and section come from
// the field table, so a new slider needs no code here.
#pragma once
#include <imgui.h>
#include <vector>

#include "scene/field_table.hpp"

namespace demo_command {

/// The sliders of an object's fields, in the table's order. `section`: only those that stand there.
template <typename Object>
void draw_sliders(const std::vector<scene::Field<Object>>& fields, Object& object,
                  std::optional<scene::Section> section = {})
{
    ImGui::PushID(&fields); // two structs may have sliders of the same label
    for (const scene::Field<Object>& field : fields) {
        if (!field.slider || (section && field.slider->section != *section) ||
            (field.shown_when && !field.shown_when(object)))
            continue;
        const scene::Slider& slider = *field.slider;
        ImGui::SliderScalar(slider.label.c_str(), ImGuiDataType_Double, &field.number(object), &slider.low,
                            &slider.high, slider.format,
                            ImGuiSliderFlags_AlwaysClamp |
                                (slider.logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
    }
    ImGui::PopID();
}

} // namespace demo_command
