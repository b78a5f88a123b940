#include <imgui.h>

#include "apps/demo_ui.hpp"

namespace app {

void draw_view(DemoState& state)
{
    if (state.loading)
        ImGui::GetForegroundDrawList()->AddText({state.view.left + 20, state.view.top + 20}, 0xffdddddd,
                                                "Reading the head ...");
}

} // namespace app
