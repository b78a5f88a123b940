#include "base/text.hpp"

#include <cstdint>
#include <fmt/format.h>

namespace base {
namespace {

/// The number of bytes of the well-formed UTF-8 character at the start of `text`; 0 if there is none.
std::size_t character_length(std::string_view text)
{
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? std::uint8_t(text[i]) : std::uint8_t(0);
    };
    const auto continues = [&](std::size_t i) { return (byte(i) & 0xc0) == 0x80; };
    const std::uint8_t first = byte(0), second = byte(1);
    if (text.empty())
        return 0;
    if (first < 0x80)
        return 1;
    if (first >= 0xc2 && first <= 0xdf)
        return continues(1) ? 2 : 0;
    const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
    const bool beyond = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
    if (overlong || beyond)
        return 0;
    if (first >= 0xe0 && first <= 0xef)
        return continues(1) && continues(2) ? 3 : 0;
    if (first >= 0xf0 && first <= 0xf4)
        return continues(1) && continues(2) && continues(3) ? 4 : 0;
    return 0;
}

/// C0, DEL and C1 (U+0080 to U+009F), some of which a terminal obeys.
bool is_control(std::string_view character)
{
    const auto first = std::uint8_t(character[0]);
    return first < 0x20 || first == 0x7f || (first == 0xc2 && std::uint8_t(character[1]) < 0xa0);
}

} // namespace

bool is_utf8(std::string_view text)
{
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        if (length == 0)
            return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string printable(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
        if (character == "\n" || character == "\r" || character == "\t")
            result += ' ';
        else if (length == 0 || is_control(character))
            for (const char c : character)
                result += fmt::format("\\x{:02x}", std::uint8_t(c));
        else
            result += character;
        text.remove_prefix(character.size());
    }
    return result;
}

} // namespace base
