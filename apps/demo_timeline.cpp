#include <imgui.h>

#include "apps/demo_ui.hpp"

namespace app {

void draw_timeline(DemoState& state)
{
    Playback& playback = state.playback;
    if (ImGui::Button(playback.playing ? "Pause" : "Play", {70 * state.scale, 0}))
        playback.toggle();
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    float day = float(playback.day);
    if (ImGui::SliderFloat("##day", &day, 0, float(playback.last_day), "day %.1f"))
        playback.seek(day);
}

} // namespace app
