// Points with their names on logarithmic axes.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace lab {

struct PlotPoint
{
    std::string name;
    double x, y; // > 0
};
/// Points on logarithmic axes, their names beside them where no other name or point is.
cv::Mat3b draw_plot(const std::vector<PlotPoint>& points, const std::string& x_label,
                    const std::string& y_label);

} // namespace lab
