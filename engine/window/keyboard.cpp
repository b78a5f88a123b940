#include "engine/window/keyboard.hpp"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <utility>

namespace window {

namespace {

bool is_shift(int key)
{
    return key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT;
}

bool is_modifier(int key)
{
    return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

} // namespace

FrameKeys Keyboard::take(bool text_wanted)
{
    using enum KeyEvent::Kind;
    FrameKeys frame;
    const bool rests = std::exchange(resting_, false);
    std::vector<int> down; // in this frame, by keys that write nothing
    for (; !events_.empty(); events_.pop_front()) {
        const KeyEvent& event = events_.front();
        if (event.kind == Text) {
            if (text_wanted && (rests || resting_))
                break;
            if (text_wanted)
                frame.text.push_back(event.text);
        } else if (event.kind == Up) {
            if (std::ranges::find(down, event.key) != down.end() || (is_modifier(event.key) && resting_))
                break;
            frame.changes.push_back({event.key, false});
        } else if (is_modifier(event.key)) {
            if (!frame.text.empty() && !is_shift(event.key)) // text under Ctrl would be none
                break;
            if (event.kind == Down)
                frame.changes.push_back({event.key, true});
        } else {
            // A space also presses buttons: a key that writes nothing, and its text behind it.
            const bool writes =
                text_wanted && events_.size() > 1 && events_[1].kind == Text && events_[1].text != U' ';
            if (writes ? rests || resting_ : !frame.text.empty() || (rests && event.kind == Down))
                break;
            frame.presses.push_back(event.press);
            if (event.kind == Down)
                frame.changes.push_back({event.key, true});
            if (!writes) {
                resting_ = true;
                down.push_back(event.key);
            }
        }
    }
    return frame;
}

} // namespace window
