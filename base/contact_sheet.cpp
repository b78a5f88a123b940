#include "base/contact_sheet.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "base/draw_text.hpp"
#include "base/palette.hpp"

namespace base {
namespace {

const cv::Vec3b page_color = rgb_of(palette::paper);
constexpr int gap = 12, label_height = 30, header_height = 44;

void paste(cv::Mat3b& page, const cv::Mat3b& picture, cv::Point at)
{
    picture.copyTo(page(cv::Rect(at, picture.size())));
}

/// Composites straight alpha over the page's colour.
cv::Mat3b on_page(const cv::Mat4b& rgba)
{
    cv::Mat3b result(rgba.size());
    for (int y = 0; y < rgba.rows; ++y)
        for (int x = 0; x < rgba.cols; ++x) {
            const cv::Vec4b& pixel = rgba(y, x);
            for (int c = 0; c < 3; ++c)
                result(y, x)[c] = uchar((pixel[c] * pixel[3] + page_color[c] * (255 - pixel[3]) + 127) / 255);
        }
    return result;
}

} // namespace

cv::Mat3b sheet_picture(const cv::Mat& picture, int cell_width)
{
    const cv::Mat3b opaque = picture.channels() == 4 ? on_page(picture) : cv::Mat3b(picture);
    cv::Mat3b small;
    cv::resize(opaque, small, {cell_width, std::max(1, picture.rows * cell_width / picture.cols)}, 0, 0,
               cv::INTER_AREA);
    return small;
}

cv::Mat3b contact_sheet(const std::string& title, const std::vector<SheetCell>& cells, int columns)
{
    columns = std::max(1, std::min(columns, int(cells.size())));
    const int cell_width = cells.front().face.cols, face_height = cells.front().face.rows;
    const int close_height = cells.front().close_up.rows;
    const int row_height = face_height + close_height + label_height + gap + 4;
    const int rows = (int(cells.size()) + columns - 1) / columns;
    cv::Mat3b page(header_height + rows * row_height + gap, gap + columns * (cell_width + gap), page_color);
    const double label_text = std::min(11., cell_width / 25.); // narrow cells hold as many letters
    const double title_text = std::min(14., 14. * (page.cols - 2 * gap) / std::max(1., text_width(title, 14)));
    draw_text(page, title, {gap, header_height - 16}, {.height = title_text});
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const int x = gap + int(i) % columns * (cell_width + gap);
        const int y = header_height + int(i) / columns * row_height;
        paste(page, cells[i].face, {x, y});
        if (close_height > 0)
            paste(page, cells[i].close_up, {x, y + face_height + 4});
        draw_text(page, cells[i].label, {x, y + face_height + close_height + 24}, {.height = label_text});
    }
    return page;
}

} // namespace base
