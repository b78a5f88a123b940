#include "apps/bake/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace bake_command {

namespace {

const cv::Scalar ink(40, 40, 40), faint(215, 215, 215);

void write(cv::Mat3b& picture, const std::string& text, cv::Point at, double scale = 0.4)
{
    cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, ink, 1, cv::LINE_AA);
}

cv::Mat3b encoded(const cv::Mat3f& linear)
{
    cv::Mat3b result(linear.size());
    for (int y = 0; y < linear.rows; ++y)
        for (int x = 0; x < linear.cols; ++x)
            result(y, x) = base::srgb8_from_linear(linear(y, x));
    return result;
}

cv::Scalar swatch(const base::Color& color)
{
    const cv::Vec3b rgb = base::srgb8_from_linear(color);
    return {static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2])};
}

int width_of(const std::string& text, double scale = 0.4)
{
    int baseline = 0;
    return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, 1, &baseline).width;
}

struct Tick
{
    double value;
    int pixel;
};
// Those of `values` below `last`, and both ends; without what lies closer than `gap` pixels to one before it
// or to the end.
template <typename Place>
std::vector<Tick> ticks(std::initializer_list<double> values, double last, int gap, Place place)
{
    std::vector<Tick> result;
    const Tick end{last, place(last)};
    for (const double value : values)
        if (const Tick tick{value, place(value)}; value < last && end.pixel - tick.pixel >= gap &&
                                                  (result.empty() || tick.pixel - result.back().pixel >= gap))
            result.push_back(tick);
    result.push_back(end);
    return result;
}

void draw_table(cv::Mat3b& picture, cv::Rect area, const cv::Mat3f& table, const shared::LutAxes& axes)
{
    cv::resize(encoded(table), picture(area), area.size(), 0, 0, cv::INTER_NEAREST);
    const auto along = [&](double value, int texels, float last, int length) {
        const float share =
            shared::lut_coordinate(static_cast<float>(value), static_cast<float>(texels), last);
        return static_cast<int>(share * static_cast<float>(length));
    };
    for (const auto& [depth, x] : ticks({0, .1, .5, 1, 2, 4}, axes.deepest_mm, 34, [&](double value) {
             return area.x + along(value, table.cols, axes.deepest_mm, area.width);
         }))
    {
        cv::line(picture, {x, area.br().y}, {x, area.br().y + 5}, ink);
        const std::string text = fmt::format("{:.3g}", depth);
        write(picture, text, {x - width_of(text) / 2, area.br().y + 18});
    }
    write(picture, "depth of the injury, mm", {area.x + 70, area.br().y + 40});
    for (const auto& [day, y] :
         ticks({0, 1, 3, 7, 14, 30, 60, 120, 365, 1000}, axes.last_day, 12,
               [&](double value) { return area.y + along(value, table.rows, axes.last_day, area.height); }))
    {
        cv::line(picture, {area.x - 5, y}, {area.x, y}, ink);
        const std::string text = fmt::format("{:g}", day);
        write(picture, text, {area.x - 9 - width_of(text), y + 4});
    }
}

} // namespace

cv::Mat3b draw_tables(const std::string& title, const std::vector<std::pair<std::string, cv::Mat3f>>& tables,
                      const shared::LutAxes& axes)
{
    constexpr int side = 320, left = 60, top = 66, bottom = 60, gap = 60;
    const int count = static_cast<int>(tables.size());
    cv::Mat3b picture(top + side + bottom, std::max(left + count * (side + gap), width_of(title, 0.5) + 16),
                      cv::Vec3b(255, 255, 255));
    write(picture, title, {8, 22}, 0.5);
    for (int i = 0; i < count; ++i) {
        const auto& [name, table] = tables[static_cast<std::size_t>(i)];
        const cv::Rect area(left + i * (side + gap), top, side, side);
        write(picture, name, {area.x, top - 14}, 0.5);
        draw_table(picture, area, table, axes);
    }
    write(picture, "day", {8, top - 14});
    return picture;
}

cv::Mat3b draw_strip(const std::string& title, const std::vector<double>& days,
                     const std::vector<ColorRow>& rows)
{
    constexpr int width = 56, height = 64, left = 230, top = 62, gap = 10;
    std::vector<int> x{left};
    for (std::size_t i = 1; i < days.size(); ++i) {
        const bool changes = i > 1 && days[i] - days[i - 1] != days[i - 1] - days[i - 2];
        x.push_back(x.back() + width + (changes ? gap : 0));
    }
    cv::Mat3b picture(top + static_cast<int>(rows.size()) * (height + 8),
                      std::max(x.back() + width + 10, width_of(title, 0.5) + 20), cv::Vec3b(255, 255, 255));
    write(picture, title, {10, 22}, 0.5);
    write(picture, "day", {10, 50});
    for (std::size_t i = 0; i < days.size(); ++i)
        write(picture, fmt::format("{:g}", days[i]), {x[i] + 16, 50});
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const int y = top + static_cast<int>(r) * (height + 8);
        write(picture, rows[r].name, {10, y + height / 2 - 5}, 0.45);
        write(picture, rows[r].detail, {10, y + height / 2 + 14});
        for (std::size_t i = 0; i < rows[r].colors.size(); ++i) {
            const cv::Rect place(x[i], y, width, height);
            if (const auto& color = rows[r].colors[i])
                cv::rectangle(picture, place, swatch(*color), cv::FILLED);
            else
                write(picture, "closed", {place.x + 6, y + height / 2 + 4});
            cv::rectangle(picture, place, faint); // white swatches are seen to be there
        }
    }
    return picture;
}

} // namespace bake_command
