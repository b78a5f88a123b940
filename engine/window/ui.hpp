// Dear ImGui in a window: context, input, fonts and style. Call ImGui's functions between begin() and end();
// Swapchain::show draws the result of end().
#pragma once
#include <array>
#include <cstdint>

#include "engine/window/ui_renderer.hpp"
#include "engine/window/window.hpp"

struct ImDrawData;

namespace window {

class Ui
{
  public:
    /// `scale`: of text and controls; 0: the screen's scale.
    Ui(Window& window, double scale);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    /// Updates the scale, which changes when the window moves to another screen.
    void begin(UiRenderer& renderer, const FrameKeys& keys);
    const ImDrawData* end();
    /// Whether the last end() returned other draw data than the end() before.
    bool changed() const { return last_hash_ != hash_; }
    /// Pixels of the window per unit of ImGui's coordinates.
    float pixels_per_unit() const;
    /// Factor for sizes that are given for an ordinary screen.
    float scale() const { return current_scale_; }

  private:
    void tell_keys(const FrameKeys& keys);
    void tell_mouse();
    float wanted_scale() const;
    void set_scale(float scale);

    Window& window_;
    double forced_scale_;
    float current_scale_ = 0;
    std::array<bool, 3> buttons_{}; // mouse buttons as reported to ImGui
    bool fonts_changed_ = true;
    std::uint64_t hash_ = 0, last_hash_ = 0;
};

} // namespace window
