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
    const bool was_resting = std::exchange(resting_, false);
    std::vector<int> down; // pressed in this frame, writing no text
    for (; !events_.empty(); events_.pop_front()) {
        const KeyEvent& event = events_.front();
        if (event.kind == Text) {
            if (text_wanted && (was_resting || resting_))
                break;
            if (text_wanted)
                frame.text.push_back(event.text);
        } else if (event.kind == Up) {
            if (std::ranges::find(down, event.key) != down.end() || (is_modifier(event.key) && resting_))
                break;
            frame.changes.push_back({event.key, false});
        } else if (is_modifier(event.key)) {
            if (!frame.text.empty() && !is_shift(event.key)) // with Ctrl down the text would be ignored
                break;
            if (event.kind == Down)
                frame.changes.push_back({event.key, true});
        } else {
            // A space also presses buttons, so it counts as a key that writes no text; its text follows.
            const bool writes =
                text_wanted && events_.size() > 1 && events_[1].kind == Text && events_[1].text != U' ';
            if (writes ? was_resting || resting_ : !frame.text.empty() || (was_resting && event.kind == Down))
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
