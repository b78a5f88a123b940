#include "base/sampling.hpp"

#include <opencv2/imgproc.hpp>

namespace base {

std::vector<cv::Mat> mip_levels(const cv::Mat& image)
{
    CV_Assert(image.depth() == CV_32F && !image.empty());
    std::vector<cv::Mat> levels{image};
    while (levels.back().cols > 1 || levels.back().rows > 1) {
        const cv::Mat& finer = levels.back();
        cv::Mat half;
        cv::resize(finer, half, {std::max(1, finer.cols / 2), std::max(1, finer.rows / 2)}, 0, 0,
                   cv::INTER_AREA);
        levels.push_back(half);
    }
    return levels;
}

} // namespace base
