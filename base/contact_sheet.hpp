// The labelled page that shows a healing at one glance: per day the whole face and a close-up.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace base {

struct SheetCell
{
    cv::Mat3b face, close_up; // sheet_picture() of them; without close-ups, all of those are empty
    std::string label;        // "day 12   41 % open"
};

/// As the sheet shows it, RGB: small, what is transparent on the page's colour. `picture` is RGB or RGBA.
cv::Mat3b sheet_picture(const cv::Mat& picture);

/// Rows of at most `columns` days; face above close-up above label. RGB order.
cv::Mat3b contact_sheet(const std::string& title, const std::vector<SheetCell>& cells, int columns);

} // namespace base
