// Several keys pressed within one frame of a slow device.
#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <string>

#include "engine/window/keyboard.hpp"

namespace {

using enum window::KeyEvent::Kind;

void press(window::Keyboard& keyboard, int key, char32_t text = 0)
{
    keyboard.add({.kind = Down, .key = key, .press = {.key = key}});
    if (text != 0)
        keyboard.add({.kind = Text, .text = text});
    keyboard.add({.kind = Up, .key = key});
}

void type(window::Keyboard& keyboard, const std::string& text)
{
    for (const char c : text)
        press(keyboard, c, char32_t(c));
}

/// What an interface that polls once per frame sees: text, ! for text with control down, <key> for a key that
/// was up in the frame before and is down now, and ^ before a key with shift.
std::string seen(window::Keyboard& keyboard, bool text_wanted = true)
{
    std::string text;
    std::array<bool, GLFW_KEY_LAST + 1> down{}, before{};
    for (int frame = 0; !keyboard.empty() && frame < 100; ++frame) {
        const window::FrameKeys keys = keyboard.take(text_wanted);
        for (const window::KeyChange& change : keys.changes)
            down[std::size_t(change.key)] = change.down;
        for (const int key : {GLFW_KEY_TAB, GLFW_KEY_ENTER, GLFW_KEY_SPACE})
            if (down[std::size_t(key)] && !before[std::size_t(key)])
                text += std::string(down[GLFW_KEY_LEFT_SHIFT] ? "^" : "") + "<" + std::to_string(key) + ">";
        for (const char32_t c : keys.text)
            text += down[GLFW_KEY_LEFT_CONTROL] ? '!' : char(c);
        before = down;
    }
    return text;
}

} // namespace

TEST(Keyboard, DeliversAWordInOneFrame)
{
    window::Keyboard keyboard;
    type(keyboard, "word");
    const window::FrameKeys keys = keyboard.take(true);
    EXPECT_EQ(std::u32string(keys.text.begin(), keys.text.end()), U"word");
    EXPECT_TRUE(keyboard.empty());
}

TEST(Keyboard, KeepsTextAndOtherKeysInOrder)
{
    window::Keyboard keyboard;
    type(keyboard, "96");
    press(keyboard, GLFW_KEY_TAB);
    type(keyboard, "64");
    press(keyboard, GLFW_KEY_TAB);
    press(keyboard, GLFW_KEY_TAB);
    press(keyboard, GLFW_KEY_SPACE, U' ');
    press(keyboard, GLFW_KEY_ENTER);
    EXPECT_EQ(seen(keyboard), "96<258>64<258><258><32> <257>");
}

TEST(Keyboard, TextAfterAKeyWithoutTextWaitsUntilThatKeyIsUp)
{
    window::Keyboard keyboard;
    press(keyboard, GLFW_KEY_TAB);
    type(keyboard, "a");
    EXPECT_THAT(keyboard.take(true).changes, testing::SizeIs(1));
    const window::FrameKeys after = keyboard.take(true);
    EXPECT_THAT(after.changes, testing::SizeIs(1)); // up again
    EXPECT_THAT(after.text, testing::IsEmpty());
    EXPECT_THAT(keyboard.take(true).text, testing::ElementsAre(U'a'));
}

TEST(Keyboard, KeepsShiftWithItsKey)
{
    window::Keyboard keyboard;
    type(keyboard, "a");
    keyboard.add({.kind = Down, .key = GLFW_KEY_LEFT_SHIFT});
    keyboard.add({.kind = Down, .key = GLFW_KEY_TAB});
    keyboard.add({.kind = Up, .key = GLFW_KEY_LEFT_SHIFT});
    keyboard.add({.kind = Up, .key = GLFW_KEY_TAB});
    keyboard.add({.kind = Down, .key = GLFW_KEY_LEFT_SHIFT});
    type(keyboard, "B");
    keyboard.add({.kind = Up, .key = GLFW_KEY_LEFT_SHIFT});
    type(keyboard, "c");
    press(keyboard, GLFW_KEY_TAB);
    EXPECT_EQ(seen(keyboard), "a^<258>Bc<258>");
}

TEST(Keyboard, DoesNotApplyControlToTextBeforeIt)
{
    window::Keyboard keyboard;
    type(keyboard, "ab");
    keyboard.add({.kind = Down, .key = GLFW_KEY_LEFT_CONTROL});
    press(keyboard, GLFW_KEY_S);
    keyboard.add({.kind = Up, .key = GLFW_KEY_LEFT_CONTROL});
    type(keyboard, "c");
    EXPECT_EQ(seen(keyboard), "abc");
}

// A letter that opens a dialog must not be written into it.
TEST(Keyboard, DropsTextWhereNoneIsWanted)
{
    window::Keyboard keyboard;
    type(keyboard, "h");
    const window::FrameKeys keys = keyboard.take(false);
    EXPECT_THAT(keys.presses, testing::SizeIs(1));
    EXPECT_THAT(keys.text, testing::IsEmpty());
    keyboard.take(true);
    EXPECT_TRUE(keyboard.empty());
}

TEST(Keyboard, DeliversTheRepeatsOfAHeldKeyAtOnce)
{
    window::Keyboard keyboard;
    keyboard.add({.kind = Down, .key = GLFW_KEY_RIGHT, .press = {.key = GLFW_KEY_RIGHT}});
    for (int i = 0; i < 30; ++i)
        keyboard.add({.kind = Repeat, .key = GLFW_KEY_RIGHT, .press = {.key = GLFW_KEY_RIGHT}});
    EXPECT_THAT(keyboard.take(false).presses, testing::SizeIs(31));
    for (int i = 0; i < 30; ++i)
        keyboard.add({.kind = Repeat, .key = GLFW_KEY_RIGHT, .press = {.key = GLFW_KEY_RIGHT}});
    EXPECT_THAT(keyboard.take(false).presses, testing::SizeIs(30));
}
