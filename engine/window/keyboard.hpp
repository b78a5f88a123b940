// The keyboard between a window and a frame. On a slow device many keys come within one frame, and an
// interface that looks once a frame would lose some and mix up others: text typed before and after a Tab,
// say.
#pragma once
#include <deque>
#include <vector>

namespace window {

struct KeyPress
{
    int key = 0; // GLFW_KEY_..., a place on a US keyboard; of a letter, what it writes
    bool control = false, shift = false, alt = false;
};

/// A key went down or up.
struct KeyChange
{
    int key = 0; // GLFW_KEY_...
    bool down = false;
};

/// As the window system tells it.
struct KeyEvent
{
    enum class Kind
    {
        Down,
        Repeat, // is held down
        Up,
        Text, // what the key before wrote
    };
    Kind kind = Kind::Down;
    int key = 0;       // GLFW_KEY_...
    KeyPress press{};  // Down, Repeat
    char32_t text = 0; // Text
};

/// What one frame is told.
struct FrameKeys
{
    std::vector<KeyChange> changes; // in order
    std::vector<KeyPress> presses;  // in order, repeated ones as well
    std::vector<char32_t> text;
};

class Keyboard
{
  public:
    void add(const KeyEvent& event) { events_.push_back(event); }
    /// As much as one frame can be told without losing or mixing up any of it: text, or keys that write none
    /// (Tab, Enter, Ctrl+S), which have the next frame to themselves as well, for what they do shows only
    /// then. `text_wanted`: somebody is being written to; otherwise all keys are of the second kind.
    FrameKeys take(bool text_wanted);
    bool empty() const { return events_.empty(); }

  private:
    std::deque<KeyEvent> events_;
    bool resting_ = false; // the frame before was told of a key that writes nothing
};

} // namespace window
