// Dear ImGui in a window: its context, input, fonts and look. Between begin() and end() ImGui's functions may
// be called; what end() returns is drawn by Swapchain::show.
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
    /// `scale` of text and controls; 0: the screen's own.
    Ui(Window& window, double scale);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    /// Follows the screen's scale, which changes when the window moves to another.
    void begin(UiRenderer& renderer, const FrameKeys& keys);
    const ImDrawData* end();
    /// Whether the last end() returned something else than the one before.
    bool changed() const { return last_hash_ != hash_; }
    /// Pixels of the window per unit of ImGui's coordinates.
    float pixels_per_unit() const;
    /// Multiplies sizes given for an ordinary screen.
    float scale() const { return current_scale_; }

  private:
    void tell_keys(const FrameKeys& keys);
    void tell_mouse();
    float wanted_scale() const;
    void set_scale(float scale);

    Window& window_;
    double forced_scale_;
    float current_scale_ = 0;
    std::array<bool, 3> buttons_{}; // of the mouse, as ImGui has been told
    bool fonts_changed_ = true;
    std::uint64_t hash_ = 0, last_hash_ = 0;
};

} // namespace window
