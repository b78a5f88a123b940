#include "apps/contact_sheet.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace app {
namespace {

const cv::Scalar ink(40, 40, 44);
constexpr int gap = 12, label_height = 30, title_height = 44;

/// Scales to `width`, keeping the shape.
cv::Mat3b fitted(const cv::Mat3b& picture, int width)
{
    cv::Mat3b out;
    cv::resize(picture, out, {width, std::max(1, picture.rows * width / picture.cols)}, 0, 0, cv::INTER_AREA);
    return out;
}

void paste(cv::Mat3b& page, const cv::Mat3b& picture, cv::Point at)
{
    picture.copyTo(page(cv::Rect(at, picture.size())));
}

} // namespace

void draw_label(cv::Mat3b& picture, const std::string& text, cv::Point origin, double height_px,
                cv::Scalar color)
{
    cv::putText(picture, text, origin, cv::FONT_HERSHEY_SIMPLEX, height_px / 22.0, color, 1, cv::LINE_AA);
}

cv::Mat3b contact_sheet(const std::string& title, const std::vector<SheetCell>& cells, int columns)
{
    columns = std::max(1, std::min(columns, int(cells.size())));
    constexpr int width = 300;
    const int face_height = fitted(cells.front().face, width).rows;
    const int close_height = fitted(cells.front().close_up, width).rows;
    const int row_height = face_height + close_height + label_height + gap + 4;
    const int rows = (int(cells.size()) + columns - 1) / columns;
    cv::Mat3b page(title_height + rows * row_height + gap, gap + columns * (width + gap),
                   cv::Vec3b(250, 249, 247));
    draw_label(page, title, {gap, title_height - 16}, 14, ink);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const int x = gap + int(i) % columns * (width + gap);
        const int y = title_height + int(i) / columns * row_height;
        paste(page, fitted(cells[i].face, width), {x, y});
        paste(page, fitted(cells[i].close_up, width), {x, y + face_height + 4});
        draw_label(page, cells[i].label, {x, y + face_height + close_height + 24}, 11, ink);
    }
    return page;
}

} // namespace app
