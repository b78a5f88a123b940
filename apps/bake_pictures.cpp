#include "apps/bake_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace app {

namespace {

const cv::Scalar ink(40, 40, 40), paper(255, 255, 255), faint(215, 215, 215);

void write(cv::Mat3b& picture, const std::string& text, cv::Point at, double scale = 0.4)
{
    cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, ink, 1, cv::LINE_AA);
}

cv::Mat3b encoded(const cv::Mat3f& linear)
{
    cv::Mat3b result(linear.size());
    for (int y = 0; y < linear.rows; ++y)
        for (int x = 0; x < linear.cols; ++x)
            result(y, x) = wound::srgb8_from_linear(linear(y, x));
    return result;
}

cv::Scalar swatch(const wound::Color& color)
{
    const cv::Vec3b rgb = wound::srgb8_from_linear(color);
    return {static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2])};
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

} // namespace

cv::Mat3b draw_tables(const std::vector<std::pair<std::string, cv::Mat3f>>& tables,
                      const shared::LutAxes& axes)
{
    constexpr int side = 320, left = 60, top = 40, bottom = 60, gap = 60;
    const int count = static_cast<int>(tables.size());
    cv::Mat3b picture(top + side + bottom, left + count * (side + gap), cv::Vec3b(255, 255, 255));
    for (int i = 0; i < count; ++i) {
        const auto& [name, table] = tables[static_cast<std::size_t>(i)];
        const cv::Rect area(left + i * (side + gap), top, side, side);
        cv::resize(encoded(table), picture(area), area.size(), 0, 0, cv::INTER_NEAREST);
        write(picture, name, {area.x, top - 14}, 0.5);
        for (float depth : {0.f, .1f, .5f, 1.f, 2.f, 4.f})
            if (depth <= axes.deepest_mm) {
                const float u =
                    shared::lut_coordinate(depth, static_cast<float>(table.cols), axes.deepest_mm);
                const int x = area.x + static_cast<int>(u * side);
                cv::line(picture, {x, area.br().y}, {x, area.br().y + 5}, ink);
                write(picture, fmt::format("{:g}", depth), {x - 8, area.br().y + 18});
            }
        write(picture, "depth of the injury, mm", {area.x + 70, area.br().y + 40});
        for (float day : {0.f, 1.f, 3.f, 7.f, 14.f, 30.f, 60.f, 120.f, 365.f})
            if (day <= axes.last_day) {
                const float v = shared::lut_coordinate(day, static_cast<float>(table.rows), axes.last_day);
                const int y = area.y + static_cast<int>(v * side);
                cv::line(picture, {area.x - 5, y}, {area.x, y}, ink);
                write(picture, fmt::format("{:g}", day), {area.x - 30, y + 4});
            }
    }
    write(picture, "day", {8, top - 14});
    return picture;
}

cv::Mat3b draw_strip(const std::vector<double>& days, const std::vector<ColorRow>& rows)
{
    constexpr int width = 56, height = 64, left = 190, top = 34;
    cv::Mat3b picture(top + static_cast<int>(rows.size()) * (height + 8),
                      left + static_cast<int>(days.size()) * width + 10, cv::Vec3b(255, 255, 255));
    write(picture, "day", {10, 22});
    for (std::size_t i = 0; i < days.size(); ++i)
        write(picture, fmt::format("{:g}", days[i]), {left + static_cast<int>(i) * width + 16, 22});
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const int y = top + static_cast<int>(r) * (height + 8);
        write(picture, rows[r].name, {10, y + height / 2 + 4});
        for (std::size_t i = 0; i < rows[r].colors.size(); ++i)
            cv::rectangle(picture, cv::Rect(left + static_cast<int>(i) * width, y, width, height),
                          swatch(rows[r].colors[i]), cv::FILLED);
    }
    return picture;
}

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
    for (const PlotPoint& point : points) {
        const cv::Point at = place(point.x, point.y);
        cv::circle(picture, at, 5, cv::Scalar(170, 40, 40), cv::FILLED, cv::LINE_AA);
        write(picture, point.name, at + cv::Point(9, -6), 0.42);
    }
    write(picture, x_label, {left + width / 2 - 110, top + height + 44}, 0.45);
    write(picture, y_label, {10, 22}, 0.45);
    return picture;
}

} // namespace app
