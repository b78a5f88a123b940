#include "base/svg.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace base {

std::string escaped(std::string_view text)
{
    std::string result;
    for (const char c : text)
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    return result;
}

Svg::Svg(double width, double height, std::string_view label)
    : svg_(fmt::format("<svg viewBox=\"0 0 {0:g} {1:g}\" style=\"max-width:{0:g}px\" role=\"img\" "
                       "aria-label=\"{2}\">",
                       width, height, escaped(label)))
{
}

void Svg::rect(double x, double y, double width, double height, std::string_view fill, std::string_view title,
               double opacity)
{
    svg_ += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
                        "opacity=\"{:g}\">",
                        x, y, std::max(width, 0.1), std::max(height, 0.1), fill, opacity);
    svg_ += title.empty() ? "</rect>" : fmt::format("<title>{}</title></rect>", escaped(title));
}

void Svg::line(double x0, double y0, double x1, double y1, std::string_view stroke, double width)
{
    svg_ += fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" "
                        "stroke-width=\"{:g}\"/>",
                        x0, y0, x1, y1, stroke, width);
}

void Svg::circle(double x, double y, double radius, std::string_view fill, double opacity)
{
    svg_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:g}\" fill=\"{}\" opacity=\"{:g}\"/>", x, y,
                        radius, fill, opacity);
}

void Svg::text(double x, double y, std::string_view text, std::string_view anchor, std::string_view fill)
{
    svg_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>", x, y,
                        anchor, fill, escaped(text));
}

} // namespace base
