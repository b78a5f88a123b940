// The page of a comparison: a row of pictures for each shot, and the colour scale of the difference maps.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace compare_command {

struct PageRow
{
    std::vector<cv::Mat3b> cells; // of equal size, RGB
    std::string label;
};

/// `values` from 0 to `top` as colours, black to yellow; grey where `where` is 0.
cv::Mat3b color_mapped(const cv::Mat1f& values, double top, const cv::Mat1b& where);
/// `values` from -top to top as colours, blue below 0, white, red above; grey where `where` is 0.
cv::Mat3b signed_color_mapped(const cv::Mat1f& values, double top, const cv::Mat1b& where);

/// A title per column, at least one row. `top`: of the colour scale, which is that of color_mapped().
cv::Mat3b draw_page(const std::vector<std::string>& titles, const std::vector<PageRow>& rows, double top);

} // namespace compare_command
