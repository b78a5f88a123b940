#include "tools/lab/named_plot.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace lab {

namespace {

const cv::Scalar ink(40, 40, 40), faint(215, 215, 215);

void write(cv::Mat3b& picture, const std::string& text, cv::Point at, double scale = 0.4)
{
    cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, ink, 1, cv::LINE_AA);
}

int width_of(const std::string& text, double scale = 0.4)
{
    int baseline = 0;
    return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, 1, &baseline).width;
}

// Powers of ten that enclose the values.
struct LogAxis
{
    double low, high;
    double at(double value) const { return (std::log10(value) - low) / (high - low); }
};

template <typename Get>
LogAxis log_axis(const std::vector<PlotPoint>& points, Get get)
{
    LogAxis axis{1e9, -1e9};
    for (const PlotPoint& point : points) {
        axis.low = std::min(axis.low, std::floor(std::log10(get(point))));
        axis.high = std::max(axis.high, std::ceil(std::log10(get(point))));
    }
    axis.high = std::max(axis.high, axis.low + 1);
    return axis;
}

// The first place beside a point where its name meets none of `taken`; the first of all when there is none.
cv::Rect place_name(const std::string& name, cv::Point point, const std::vector<cv::Rect>& taken)
{
    const cv::Size size(width_of(name, 0.42), 13);
    const int right = point.x + 9, left = point.x - 9 - size.width, middle = point.x - size.width / 2;
    const cv::Point corners[] = {{right, point.y - 17}, {right, point.y + 4},   {left, point.y - 17},
                                 {left, point.y + 4},   {middle, point.y - 21}, {middle, point.y + 9}};
    for (const cv::Point corner : corners) {
        const cv::Rect rect(corner, size);
        if (std::ranges::none_of(taken, [&](const cv::Rect& other) { return (rect & other).area() > 0; }))
            return rect;
    }
    return {corners[0], size};
}

} // namespace

cv::Mat3b draw_plot(const std::vector<PlotPoint>& points, const std::string& x_label,
                    const std::string& y_label)
{
    constexpr int left = 80, top = 40, width = 620, height = 380;
    cv::Mat3b picture(top + height + 60, left + width + 140, cv::Vec3b(255, 255, 255));
    const LogAxis x = log_axis(points, [](const PlotPoint& p) { return p.x; });
    const LogAxis y = log_axis(points, [](const PlotPoint& p) { return p.y; });
    const auto place = [&](double px, double py) {
        return cv::Point(left + static_cast<int>(x.at(px) * width),
                         top + height - static_cast<int>(y.at(py) * height));
    };
    for (double power = x.low; power <= x.high; ++power) {
        const cv::Point foot = place(std::pow(10, power), std::pow(10, y.low));
        cv::line(picture, foot, {foot.x, top}, faint);
        write(picture, fmt::format("{:g}", std::pow(10, power)), {foot.x - 14, foot.y + 18});
    }
    for (double power = y.low; power <= y.high; ++power) {
        const cv::Point foot = place(std::pow(10, x.low), std::pow(10, power));
        cv::line(picture, foot, {left + width, foot.y}, faint);
        write(picture, fmt::format("{:g}", std::pow(10, power)), {foot.x - 60, foot.y + 4});
    }
    std::vector<cv::Rect> taken;
    for (const PlotPoint& point : points) {
        const cv::Point at = place(point.x, point.y);
        cv::circle(picture, at, 5, cv::Scalar(170, 40, 40), cv::FILLED, cv::LINE_AA);
        taken.emplace_back(at - cv::Point(6, 6), cv::Size(12, 12));
    }
    for (const PlotPoint& point : points) {
        taken.push_back(place_name(point.name, place(point.x, point.y), taken));
        write(picture, point.name, {taken.back().x, taken.back().y + 10}, 0.42);
    }
    write(picture, x_label, {left + width / 2 - 110, top + height + 44}, 0.45);
    write(picture, y_label, {10, 22}, 0.45);
    return picture;
}

} // namespace lab
