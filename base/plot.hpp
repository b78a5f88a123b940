// A small chart drawn into a picture (RGB): axes with round ticks, lines, points, a legend.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace base {

struct Range
{
    double low = 0, high = 1;
    bool logarithmic = false; // both ends > 0
};

class Plot
{
  public:
    /// Draws frame, ticks and titles at once. `area` is the whole chart with its labels; a range of no width
    /// is widened.
    Plot(const cv::Mat3b& picture, cv::Rect area, Range x, Range y, const std::string& title,
         const std::string& x_label);

    void line(const std::vector<cv::Point2d>& points, cv::Scalar color, int thickness = 2);
    void points(const std::vector<cv::Point2d>& points, cv::Scalar color, int radius = 4);
    /// Adds one entry to the legend, in the upper right corner.
    void legend(const std::string& text, cv::Scalar color);

  private:
    cv::Mat3b picture_; // shares the caller's pixels
    cv::Rect inner_;
    Range x_, y_;
    int legend_lines_ = 0;

    cv::Point place(cv::Point2d p) const; // in sixteenths of a pixel
};

inline constexpr int text_height = 14; // pixels
void draw_text(const cv::Mat3b& picture, const std::string& text, cv::Point lower_left,
               cv::Scalar color = {40, 40, 40}, double scale = 1);

} // namespace base
