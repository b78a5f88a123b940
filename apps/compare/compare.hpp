// `cicatrix compare`: compares the pictures of two scenes (CIEDE2000) and the costs of drawing them.
#pragma once
#include <opencv2/core.hpp>

namespace CLI {
class App;
}

namespace compare_command {

/// CIEDE2000 differences of two pictures in the pixels where both show the head.
struct ColorDifference
{
    cv::Mat1f map;                                                    // 0 outside the head
    cv::Mat1b head;                                                   // 255 in the head
    int pixels = 0;                                                   // in the head
    double mean = 0, percentile_95 = 0, percentile_99_9 = 0, max = 0; // 0 without pixels
};

/// `a`, `b`: 8-bit sRGB with alpha, of equal size; alpha is 255 in the head.
ColorDifference color_difference(const cv::Mat4b& a, const cv::Mat4b& b);

void add(CLI::App& program);

} // namespace compare_command
