// The colours of charts and pages. Each has a name in the page's style sheet, a value for light pages, which
// pictures and separate files use too, and a value for dark pages.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>

namespace base {

/// A colour to draw with, sRGB as 0xrrggbb.
struct Paint
{
    std::uint32_t light = 0, dark = 0;
    std::string_view name = {}; // of the CSS variable; empty: `light` is used on every page
};

/// A paint that is the same on light and dark pages.
constexpr Paint paint(std::uint32_t rgb)
{
    return {rgb, rgb};
}
inline Paint paint(const cv::Vec3b& rgb)
{
    return paint(std::uint32_t{rgb[0]} << 16 | std::uint32_t{rgb[1]} << 8 | rgb[2]);
}

namespace palette {
inline constexpr Paint white = paint(0xffffff); // the background of charts
inline constexpr Paint paper{0xfaf9f7, 0x17181a, "paper"};
inline constexpr Paint ink{0x28282c, 0xe8e6e3, "ink"};
inline constexpr Paint faint{0x666666, 0xa2a2a2, "faint"}; // tick labels
inline constexpr Paint grid{0xdddddd, 0x3a3c3f, "grid"};
inline constexpr Paint rest{0x9a9a9a, 0x7c7c7c, "rest"}; // anything that belongs to no series
inline constexpr Paint note{0xfff1d6, 0x453510, "note"};
inline constexpr Paint slower{0xc2311f, 0xff7b66, "slower"};
inline constexpr Paint faster{0x18794e, 0x5cd39a, "faster"};
inline constexpr std::array<Paint, 10> series{{{0xb5472f, 0xe77b62, "c0"},
                                               {0x2f6fb5, 0x6ba6ea, "c1"},
                                               {0x3d8f4d, 0x77c787, "c2"},
                                               {0x8a56b0, 0xbb8fdd, "c3"},
                                               {0xc98a12, 0xe8b44c, "c4"},
                                               {0x178a8a, 0x53c4c4, "c5"},
                                               {0xc2549b, 0xe68fc6, "c6"},
                                               {0x77701f, 0xb9b25c, "c7"},
                                               {0x4f5fc4, 0x939ef0, "c8"},
                                               {0x8c5a3c, 0xc79a7e, "c9"}}};
} // namespace palette

/// The paint of series `index`; the colours repeat after the last one.
constexpr Paint series_paint(std::size_t index)
{
    return palette::series[index % palette::series.size()];
}

/// The light value in RGB order, as a pixel and as the cv::Scalar of OpenCV's drawing functions.
cv::Vec3b rgb_of(Paint paint);
cv::Scalar scalar_of(Paint paint);

/// Formats 0xrrggbb as "#28282c".
std::string hex_of(std::uint32_t rgb);
/// CSS rules that define the variables --ink, --c0 ... for light and for dark pages.
std::string css_variables();

} // namespace base
