#include <imgui.h>

#include "apps/demo_ui.hpp"

namespace app {

void draw_panels(DemoState& state, const Rectangle&)
{
    ImGui::TextDisabled("%s", state.device.c_str());
    for (const engine::PassResult& pass : state.passes)
        ImGui::Text("%s %s %.1f ms", pass.name.c_str(), name_of(pass.state), pass.gpu_ms.value_or(0));
}

} // namespace app
