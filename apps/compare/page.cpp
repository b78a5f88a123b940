#include "apps/compare/page.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/draw_text.hpp"
#include "base/palette.hpp"

namespace compare_command {
namespace {

constexpr int cell_width = 420, gap = 12, title_height = 44, label_height = 30, bar_width = 90;
const cv::Scalar outside(225, 225, 228);

void draw_color_scale(cv::Mat3b& page, cv::Rect area, double top)
{
    cv::Mat1f ramp(area.height, 1);
    for (int y = 0; y < area.height; ++y)
        ramp(y) = float(top * (area.height - 1 - y) / std::max(1, area.height - 1));
    cv::resize(color_mapped(ramp, top, cv::Mat1b(ramp.size(), uchar(255))), page(area), area.size(), 0, 0,
               cv::INTER_NEAREST);
    for (const double share : {0., .25, .5, .75, 1.})
        base::draw_text(page, fmt::format("{}{:g}", share == 1 ? ">= " : "", share * top),
                        {area.br().x + 4, int(area.br().y - share * (area.height - 12))});
}

} // namespace

cv::Mat3b color_mapped(const cv::Mat1f& values, double top, const cv::Mat1b& where)
{
    cv::Mat1b level;
    values.convertTo(level, CV_8U, 255 / top);
    cv::Mat bgr;
    cv::applyColorMap(level, bgr, cv::COLORMAP_INFERNO);
    cv::Mat3b rgb;
    cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
    rgb.setTo(outside, ~where);
    return rgb;
}

cv::Mat3b signed_color_mapped(const cv::Mat1f& values, double top, const cv::Mat1b& where)
{
    const cv::Vec3f white(255, 255, 255), red(178, 24, 43), blue(33, 102, 172);
    cv::Mat3b rgb(values.size());
    for (int y = 0; y < values.rows; ++y)
        for (int x = 0; x < values.cols; ++x) {
            const float share = std::min(1.f, std::abs(values(y, x)) / float(top));
            rgb(y, x) = cv::Vec3b((1 - share) * white + share * (values(y, x) > 0 ? red : blue));
        }
    rgb.setTo(outside, ~where);
    return rgb;
}

cv::Mat3b draw_page(const std::vector<std::string>& titles, const std::vector<PageRow>& rows, double top)
{
    const cv::Size cell = rows.front().cells.front().size();
    const int cell_height = std::max(1, cell.height * cell_width / cell.width), columns = int(titles.size());
    cv::Mat3b page(title_height + int(rows.size()) * (cell_height + label_height) + gap,
                   gap + columns * (cell_width + gap) + bar_width, base::rgb_of(base::palette::paper));
    for (int column = 0; column < columns; ++column)
        base::draw_text(page, titles[std::size_t(column)],
                        {gap + column * (cell_width + gap), title_height - 16}, {.height = 14});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const int y = title_height + int(i) * (cell_height + label_height);
        for (int column = 0; column < columns; ++column) {
            const cv::Rect place(gap + column * (cell_width + gap), y, cell_width, cell_height);
            cv::resize(rows[i].cells[std::size_t(column)], page(place), place.size(), 0, 0, cv::INTER_AREA);
        }
        base::draw_text(page, rows[i].label, {gap, y + cell_height + 20}, {.height = 11});
    }
    draw_color_scale(page, {gap + columns * (cell_width + gap), title_height, 18, cell_height}, top);
    return page;
}

} // namespace compare_command
