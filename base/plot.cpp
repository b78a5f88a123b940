#include "base/plot.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace base {

namespace {

constexpr int subpixel_bits = 4; // sixteenths of a pixel
constexpr double text_font = .45;
const cv::Scalar axis_color(90, 90, 90), grid(228, 228, 228);

/// 1, 2 or 5 times a power of ten, so that about five ticks fit.
double tick_step(Range range)
{
    const double rough = (range.high - range.low) / 5;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    for (double step : {1., 2., 5.})
        if (step * power >= rough)
            return step * power;
    return 10 * power;
}

/// Where the axis has ticks.
std::vector<double> ticks(Range range)
{
    std::vector<double> result;
    if (!range.logarithmic) {
        const double step = tick_step(range);
        for (double tick = std::ceil(range.low / step) * step; tick <= range.high + 1e-9 * step; tick += step)
            result.push_back(std::abs(tick) < 1e-9 * step ? 0 : tick);
        return result;
    }
    const bool few = range.high / range.low < 150; // then 2 and 5 times a power of ten, too
    for (double power = std::pow(10, std::floor(std::log10(range.low))); power <= range.high; power *= 10)
        for (double step : {1., 2., 5.})
            if (const double tick = step * power;
                tick >= range.low && tick <= range.high && (few || step == 1))
                result.push_back(tick);
    return result;
}

/// Where on the axis a value lies, 0 to 1.
double share(Range range, double value)
{
    if (range.logarithmic)
        return std::log(std::max(value, 1e-300) / range.low) / std::log(range.high / range.low);
    return (value - range.low) / (range.high - range.low);
}

Range widened(Range range)
{
    if (!std::isfinite(range.low) || !std::isfinite(range.high))
        return {0, 1};
    return range.high - range.low > 1e-12 ? range : Range{range.low - .5, range.low + .5};
}

} // namespace

void draw_text(const cv::Mat3b& picture, const std::string& text, cv::Point lower_left, cv::Scalar color,
               double scale)
{
    cv::Mat3b target = picture;
    cv::putText(target, text, lower_left, cv::FONT_HERSHEY_SIMPLEX, text_font * scale, color, 1, cv::LINE_AA);
}

Plot::Plot(const cv::Mat3b& picture, cv::Rect area, Range x, Range y, const std::string& title,
           const std::string& x_label)
    : picture_(picture), inner_(area.x + 56, area.y + 26, area.width - 72, area.height - 70), x_(widened(x)),
      y_(widened(y))
{
    draw_text(picture_, title, {area.x + 8, area.y + 16});
    draw_text(picture_, x_label, {inner_.x + inner_.width / 2 - 20, area.y + area.height - 10}, axis_color);
    const auto pixel = [this](cv::Point2d p) { return place(p) / (1 << subpixel_bits); };
    for (double tick : ticks(x_)) {
        const int column = pixel({tick, y_.low}).x;
        cv::line(picture_, {column, inner_.y}, {column, inner_.br().y}, grid);
        draw_text(picture_, fmt::format("{:g}", tick), {column - 8, inner_.br().y + 18}, axis_color);
    }
    for (double tick : ticks(y_)) {
        const int row = pixel({x_.low, tick}).y;
        cv::line(picture_, {inner_.x, row}, {inner_.br().x, row}, grid);
        draw_text(picture_, fmt::format("{:.4g}", tick), {inner_.x - 46, row + 5}, axis_color);
    }
    cv::rectangle(picture_, inner_, axis_color);
}

cv::Point Plot::place(cv::Point2d p) const
{
    const double x = inner_.x + std::clamp(share(x_, p.x), -.02, 1.02) * inner_.width;
    const double y = inner_.br().y - std::clamp(share(y_, p.y), -.02, 1.02) * inner_.height;
    return {cvRound(x * (1 << subpixel_bits)), cvRound(y * (1 << subpixel_bits))};
}

void Plot::line(const std::vector<cv::Point2d>& points, cv::Scalar color, int thickness)
{
    for (std::size_t i = 1; i < points.size(); ++i)
        cv::line(picture_, place(points[i - 1]), place(points[i]), color, thickness, cv::LINE_AA, subpixel_bits);
}

void Plot::points(const std::vector<cv::Point2d>& points, cv::Scalar color, int radius)
{
    for (cv::Point2d p : points)
        cv::circle(picture_, place(p), radius << subpixel_bits, color, cv::FILLED, cv::LINE_AA, subpixel_bits);
}

void Plot::legend(const std::string& text, cv::Scalar color)
{
    int baseline = 0;
    const int width = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, text_font, 1, &baseline).width;
    const cv::Point at(inner_.br().x - width - 12, inner_.y + 20 + legend_lines_++ * (text_height + 6));
    cv::line(picture_, at + cv::Point(-34, -4), at + cv::Point(-8, -4), color, 3, cv::LINE_AA);
    draw_text(picture_, text, at);
}

} // namespace base
