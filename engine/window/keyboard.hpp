// Queue of keyboard events between a window and the frames. On a slow device many events arrive within one
// frame. An interface that polls once a frame would lose some and reorder others, such as text typed before
// and after a Tab.
#pragma once
#include <deque>
#include <vector>

namespace window {

struct KeyPress
{
    int key = 0; // GLFW_KEY_..., position on a US keyboard; for letters, the character
    bool control = false, shift = false, alt = false;
};

/// A key went down or up.
struct KeyChange
{
    int key = 0; // GLFW_KEY_...
    bool down = false;
};

/// Event as the window system reports it.
struct KeyEvent
{
    enum class Kind
    {
        Down,
        Repeat, // held down
        Up,
        Text, // character from the key event before it
    };
    Kind kind = Kind::Down;
    int key = 0;       // GLFW_KEY_...
    KeyPress press{};  // Down, Repeat
    char32_t text = 0; // Text
};

/// Keyboard input of one frame.
struct FrameKeys
{
    std::vector<KeyChange> changes; // in order
    std::vector<KeyPress> presses;  // in order, including repeats
    std::vector<char32_t> text;
};

class Keyboard
{
  public:
    void add(const KeyEvent& event) { events_.push_back(event); }
    /// As many events as one frame can take without losing or reordering any: either text, or keys that write
    /// none (Tab, Enter, Ctrl+S). The frame after such a key takes neither text nor new presses, because the
    /// key's effect shows only then. `text_wanted`: a text field has the focus; else no key writes text.
    FrameKeys take(bool text_wanted);
    bool empty() const { return events_.empty(); }

  private:
    std::deque<KeyEvent> events_;
    bool resting_ = false; // the last frame took a key that writes no text
};

} // namespace window
