// Text on pictures, in one font. Sizes are the height of a capital letter in pixels.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "base/palette.hpp"

namespace base {

enum class Anchor : std::uint8_t
{
    Start,
    Middle,
    End,
};

struct TextStyle
{
    Paint paint = palette::ink;
    double height = 10; // px
    Anchor anchor = Anchor::Start;
};

/// Of a line, in pixels. SVG's charts are laid out by it too: a browser's sans-serif is no wider.
double text_width(const std::string& text, double height);

/// Anti-aliased; `at`: where the anchor is on the base line.
void draw_text(cv::Mat3b& picture, const std::string& text, cv::Point at, const TextStyle& style = {});

} // namespace base
