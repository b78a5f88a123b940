// The demo's interface: what it shows and edits, and the functions that draw it with Dear ImGui. They read
// and change the state; whatever needs the device or a file is left as a wish for the window's loop.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/demo_session.hpp"
#include "apps/scene.hpp"
#include "engine/executor.hpp"
#include "engine/swapchain.hpp"

namespace app {

/// Where things are, in ImGui's units.
struct Rectangle
{
    float left = 0, top = 0, width = 0, height = 0;
};

struct DemoState
{
    Scene scene;
    Playback playback;
    Notices notices;
    bool panels = true, help = false;
    bool loading = true;
    std::string device; // its name
    float scale = 1;    // of the interface

    // Of the last frame.
    std::vector<engine::PassResult> passes;
    double frame_ms = 0, render_scale = 1;

    Rectangle view, timeline; // laid out by draw_demo
    bool moving = false;      // something is being dragged

    struct Wishes
    {
        bool quit = false;
    } wishes;
};

/// Everything but the picture, which lies in `view`.
void draw_demo(DemoState& state);

// Parts of it, each in a file of its own.
void draw_timeline(DemoState& state);
void draw_panels(DemoState& state, const Rectangle& place);
void draw_view(DemoState& state); // what lies over the picture, and the mouse in it

} // namespace app
