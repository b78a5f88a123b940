// `cicatrix compare`: two scenes side by side, where and how much they differ to the eye, and what each
// costs.
#pragma once
#include <opencv2/core.hpp>

namespace CLI {
class App;
}

namespace compare_command {

/// CIEDE2000 between two pictures, where both show the head.
struct ColorDifference
{
    cv::Mat1f map; // 0 beside the head
    cv::Mat1b head;
    int pixels = 0;                                                   // of the head
    double mean = 0, percentile_95 = 0, percentile_99_9 = 0, max = 0; // 0 without any
};

/// Of equally large 8-bit sRGB pictures, RGBA with the head where alpha is 255.
ColorDifference color_difference(const cv::Mat4b& a, const cv::Mat4b& b);

void add(CLI::App& program);

} // namespace compare_command
