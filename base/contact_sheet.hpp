// A page that shows the healing of wounds: for each day the whole face, a close-up and a label.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace base {

inline constexpr int sheet_cell_width = 300; // px

struct SheetCell
{
    cv::Mat3b face,
        close_up;      // from sheet_picture(), of one width; close_up is empty in every cell or in none
    std::string label; // "day 12   41 % open"
};

/// Scales `picture` (RGB or RGBA) to a cell's width and composites it over the page's colour. Returns RGB.
cv::Mat3b sheet_picture(const cv::Mat& picture, int cell_width = sheet_cell_width);

/// Each row holds at most `columns` days; in a cell, face, close-up and label from top to bottom. RGB order.
cv::Mat3b contact_sheet(const std::string& title, const std::vector<SheetCell>& cells, int columns);

} // namespace base
