#include "wound/photo/agreement.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "wound/photo/segmentation.hpp"

namespace wound {

namespace {

/// The mask moved by whole pixels so that its centroid is the middle of a square of `side` pixels.
cv::Mat1b centered(const cv::Mat1b& mask, int side)
{
    const cv::Moments moments = cv::moments(mask, true);
    CV_Assert(moments.m00 > 0);
    const cv::Matx23d shift(1, 0, side / 2 - cvRound(moments.m10 / moments.m00), 0, 1,
                            side / 2 - cvRound(moments.m01 / moments.m00));
    cv::Mat1b moved;
    cv::warpAffine(mask, moved, shift, {side, side}, cv::INTER_NEAREST);
    return moved;
}

cv::Mat1b border_pixels(const cv::Mat1b& mask)
{
    cv::Mat1b inner;
    cv::erode(mask, inner, cv::Mat());
    return mask & ~inner;
}

} // namespace

cv::Mat1b predicted_mask(const PreparedWound& wound, double area_ratio)
{
    CV_Assert(!wound.photo_mask.empty());
    const cv::Mat today = warp_image(wound.patch.mask, make_warp(wound.flow, area_ratio));
    const double texels_per_pixel = today.cols / wound.photo_side;
    const auto offset = [&](double center) { return (today.cols - 1) / 2. - center * texels_per_pixel; };
    cv::Mat1f coverage;
    cv::warpAffine(today, coverage,
                   cv::Matx23d(texels_per_pixel, 0, offset(wound.photo_center.x), 0, texels_per_pixel,
                               offset(wound.photo_center.y)),
                   wound.photo_mask.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    return coverage > .5F;
}

ContourAgreement agreement(const cv::Mat1b& predicted, const cv::Mat1b& observed)
{
    const int side = 2 * std::max({predicted.cols, predicted.rows, observed.cols, observed.rows});
    const cv::Mat1b a = centered(predicted, side), b = centered(observed, side);
    cv::Mat1f distance;
    cv::distanceTransform(~border_pixels(a), distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    return {intersection_over_union(a, b), static_cast<double>(cv::countNonZero(a)) / cv::countNonZero(b),
            cv::mean(distance, border_pixels(b))[0]};
}

} // namespace wound
