#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/canvas.hpp"

namespace base {
namespace {

/// Rounds the edges to pixel borders; at least 1 x 1 pixel.
cv::Rect whole_pixels(const cv::Rect2d& area)
{
    const int x = cvRound(area.x), y = cvRound(area.y);
    return {x, y, std::max(1, cvRound(area.x + area.width) - x),
            std::max(1, cvRound(area.y + area.height) - y)};
}

/// The picture's pixels in the bounding box of two points, enlarged by `margin` pixels.
cv::Rect pixels_around(cv::Point2d a, cv::Point2d b, double margin, cv::Size picture)
{
    const cv::Rect area(cv::Point(cvFloor(std::min(a.x, b.x) - margin), cvFloor(std::min(a.y, b.y) - margin)),
                        cv::Point(cvCeil(std::max(a.x, b.x) + margin), cvCeil(std::max(a.y, b.y) + margin)));
    return area & cv::Rect({}, picture);
}

/// Raises `coverage` to each pixel's approximate coverage by the points within `radius` of the segment: 1
/// half a pixel inside the outline, 0 half a pixel outside.
void cover_segment(cv::Mat1f& coverage, cv::Point2d from, cv::Point2d to, double radius)
{
    const cv::Point2d along = to - from;
    const double squared = along.dot(along);
    const cv::Rect area = pixels_around(from, to, radius + 1, coverage.size());
    for (int y = area.y; y < area.br().y; ++y)
        for (int x = area.x; x < area.br().x; ++x) {
            const cv::Point2d off = cv::Point2d(x + .5, y + .5) - from;
            const double share = squared > 0 ? std::clamp(off.dot(along) / squared, 0., 1.) : 0;
            const double inside = radius + .5 - cv::norm(off - share * along);
            coverage(y, x) = std::max(coverage(y, x), float(std::clamp(inside, 0., 1.)));
        }
}

void blend(cv::Mat3b& picture, cv::Point corner, const cv::Mat1f& coverage, const Fill& fill)
{
    const cv::Vec3f paint = rgb_of(fill.paint);
    for (int y = 0; y < coverage.rows; ++y)
        for (int x = 0; x < coverage.cols; ++x) {
            const float opacity = coverage(y, x) * float(fill.opacity);
            cv::Vec3b& pixel = picture(corner.y + y, corner.x + x);
            pixel = cv::Vec3f(pixel) * (1 - opacity) + paint * opacity;
        }
}

} // namespace

void PictureCanvas::rect(const cv::Rect2d& area, const Fill& fill, std::string_view)
{
    const cv::Rect pixels = whole_pixels(area) & cv::Rect({}, picture_.size());
    blend(picture_, pixels.tl(), cv::Mat1f(pixels.size(), 1.f), fill);
}

void PictureCanvas::circle(cv::Point2d center, double radius, const Fill& fill, std::string_view)
{
    stroke({center}, radius, fill);
}

void PictureCanvas::polyline(const std::vector<cv::Point2d>& points, const Stroke& line)
{
    stroke(points, line.width / 2, {line.paint});
}

/// Fills the area within `radius` of the line; blends each pixel once, also where the line crosses itself.
void PictureCanvas::stroke(const std::vector<cv::Point2d>& points, double radius, const Fill& fill)
{
    if (points.empty())
        return;
    cv::Point2d low = points[0], high = points[0];
    for (const cv::Point2d& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const cv::Rect area = pixels_around(low, high, radius + 1, picture_.size());
    cv::Mat1f coverage(area.size(), 0.f);
    const cv::Point2d corner = area.tl();
    for (std::size_t i = 0; i < points.size(); ++i)
        cover_segment(coverage, points[i > 0 ? i - 1 : 0] - corner, points[i] - corner, radius);
    blend(picture_, area.tl(), coverage, fill);
}

void PictureCanvas::polygon(const std::vector<cv::Point2d>& points, const Fill& fill)
{
    constexpr int fraction_bits = 4; // sixteenths of a pixel
    std::vector<cv::Point> corners;
    for (const cv::Point2d& p :
         points) // OpenCV's integers are pixel centres, those of Canvas are pixel borders
        corners.emplace_back(cvRound((p.x - .5) * (1 << fraction_bits)),
                             cvRound((p.y - .5) * (1 << fraction_bits)));
    cv::Mat1b filled(picture_.size(), uchar(0));
    cv::fillPoly(filled, std::vector{corners}, 255, cv::LINE_AA, fraction_bits);
    cv::Mat1f coverage;
    filled.convertTo(coverage, CV_32F, 1. / 255);
    blend(picture_, {0, 0}, coverage, fill);
}

void PictureCanvas::text(cv::Point2d at, const std::string& text, const TextStyle& style)
{
    draw_text(picture_, text, cv::Point(cvRound(at.x), cvRound(at.y)), style);
}

} // namespace base
