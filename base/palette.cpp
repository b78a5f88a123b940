#include "base/palette.hpp"

#include <fmt/format.h>
#include <vector>

namespace base {

cv::Vec3b rgb_of(Paint paint)
{
    return {uchar(paint.light >> 16 & 255), uchar(paint.light >> 8 & 255), uchar(paint.light & 255)};
}

cv::Scalar scalar_of(Paint paint)
{
    const cv::Vec3b rgb = rgb_of(paint);
    return {double(rgb[0]), double(rgb[1]), double(rgb[2])};
}

std::string hex_of(std::uint32_t rgb)
{
    return fmt::format("#{:06x}", rgb);
}

std::string css_variables()
{
    std::vector<Paint> named{palette::paper, palette::ink,  palette::faint,  palette::grid,
                             palette::rest,  palette::note, palette::slower, palette::faster};
    named.insert(named.end(), palette::series.begin(), palette::series.end());
    std::string light, dark;
    for (const Paint& paint : named) {
        light += fmt::format(" --{}: {};", paint.name, hex_of(paint.light));
        dark += fmt::format(" --{}: {};", paint.name, hex_of(paint.dark));
    }
    return fmt::format(":root {{ color-scheme: light dark;{} }}\n"
                       "@media (prefers-color-scheme: dark) {{ :root {{{} }} }}\n",
                       light, dark);
}

} // namespace base
