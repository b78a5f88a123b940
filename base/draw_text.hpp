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

/// Width of one line in pixels. SVG charts use it for layout too: a browser's sans-serif font is not wider.
double text_width(const std::string& text, double height);

/// Draws anti-aliased text; `at` is the position of the anchor on the baseline.
void draw_text(cv::Mat3b& picture, const std::string& text, cv::Point at, const TextStyle& style = {});

} // namespace base
