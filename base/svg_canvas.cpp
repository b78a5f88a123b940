#include <algorithm>
#include <fmt/format.h>

#include "base/canvas.hpp"
#include "base/html.hpp"

namespace base {
namespace {

constexpr double capital_share = .73; // height of a capital letter relative to a sans-serif font's size
constexpr double least_side = .1;     // px, smallest drawn width or height of a rectangle

double font_size(double height)
{
    return height / capital_share;
}

std::string coordinates(const std::vector<cv::Point2d>& points)
{
    std::string result;
    for (const cv::Point2d& p : points)
        result += fmt::format("{}{:.2f},{:.2f}", result.empty() ? "" : " ", p.x, p.y);
    return result;
}

} // namespace

SvgCanvas::SvgCanvas(cv::Size2d size, std::string_view description, SvgUse use) : use_(use)
{
    const bool page = use == SvgUse::InPage;
    svg_ =
        fmt::format("<svg {}viewBox=\"0 0 {:g} {:g}\" style=\"{}font:{:.1f}px system-ui,sans-serif\" "
                    "role=\"img\" aria-label=\"{}\">\n",
                    page ? ""
                         : fmt::format("xmlns=\"http://www.w3.org/2000/svg\" width=\"{:g}\" height=\"{:g}\" ",
                                       size.width, size.height),
                    size.width, size.height, page ? fmt::format("max-width:{:g}px;", size.width) : "",
                    font_size(TextStyle{}.height), escaped(description));
    if (!page)
        rect({0, 0, size.width, size.height}, {palette::white});
}

std::string SvgCanvas::css(Paint paint) const
{
    return use_ == SvgUse::InPage && !paint.name.empty() ? fmt::format("var(--{})", paint.name)
                                                         : hex_of(paint.light);
}

std::string SvgCanvas::attributes(const Fill& fill) const
{
    return fmt::format("fill=\"{}\"{}", css(fill.paint),
                       fill.opacity < 1 ? fmt::format(" opacity=\"{:g}\"", fill.opacity) : "");
}

void SvgCanvas::close(std::string_view element, std::string_view tooltip)
{
    svg_ += tooltip.empty() ? "/>\n" : fmt::format("><title>{}</title></{}>\n", escaped(tooltip), element);
}

void SvgCanvas::rect(const cv::Rect2d& area, const Fill& fill, std::string_view tooltip)
{
    svg_ +=
        fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" {}", area.x, area.y,
                    std::max(area.width, least_side), std::max(area.height, least_side), attributes(fill));
    close("rect", tooltip);
}

void SvgCanvas::circle(cv::Point2d center, double radius, const Fill& fill, std::string_view tooltip)
{
    svg_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:g}\" {}", center.x, center.y, radius,
                        attributes(fill));
    close("circle", tooltip);
}

void SvgCanvas::polyline(const std::vector<cv::Point2d>& points, const Stroke& stroke)
{
    svg_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\" "
                        "stroke-linejoin=\"round\"/>\n",
                        coordinates(points), css(stroke.paint), stroke.width);
}

void SvgCanvas::polygon(const std::vector<cv::Point2d>& points, const Fill& fill)
{
    svg_ += fmt::format("<polygon points=\"{}\" {}/>\n", coordinates(points), attributes(fill));
}

void SvgCanvas::text(cv::Point2d at, const std::string& text, const TextStyle& style)
{
    const char* anchor = style.anchor == Anchor::Start    ? ""
                         : style.anchor == Anchor::Middle ? " text-anchor=\"middle\""
                                                          : " text-anchor=\"end\"";
    const std::string size = style.height == TextStyle{}.height
                                 ? ""
                                 : fmt::format(" font-size=\"{:.1f}\"", font_size(style.height));
    svg_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\"{}{} fill=\"{}\">{}</text>\n", at.x, at.y, anchor,
                        size, css(style.paint), escaped(text));
}

} // namespace base
