#include "apps/bake/pictures.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/axis.hpp"
#include "base/canvas.hpp"

namespace bake_command {

namespace {

constexpr double heading = 11, text = 9; // height of a capital letter, px

cv::Mat3b encoded(const cv::Mat3f& linear)
{
    cv::Mat3b result(linear.size());
    for (int y = 0; y < linear.rows; ++y)
        for (int x = 0; x < linear.cols; ++x)
            result(y, x) = base::srgb8_from_linear(linear(y, x));
    return result;
}

cv::Mat3b blank(int height, int width)
{
    // Parentheses: braces would select the initializer-list constructor.
    return cv::Mat3b(height, width, base::rgb_of(base::palette::white));
}

double text_extent(const std::string& label)
{
    return base::text_width(label, text);
}

/// Ticks at the texel positions of `last` and of those `values` below it whose labels stay `gap` pixels
/// apart; the axis starts at pixel `begin` and is `length` pixels long.
std::vector<base::Tick> table_ticks(std::vector<double> values, float last, int texels, double begin,
                                    double length, const base::Extent& extent, double gap)
{
    std::erase_if(values, [&](double value) { return value >= last; });
    values.push_back(last);
    std::vector<base::Tick> ticks;
    for (const double value : values) {
        const float share =
            shared::lut_coordinate(static_cast<float>(value), static_cast<float>(texels), last);
        ticks.push_back({value, begin + share * length, fmt::format("{:.3g}", value)});
    }
    return base::keep_apart(ticks, extent, gap);
}

void draw_table(cv::Mat3b& picture, cv::Rect area, const cv::Mat3f& table, const shared::LutAxes& axes)
{
    constexpr double tick = 5; // px
    cv::resize(encoded(table), picture(area), area.size(), 0, 0, cv::INTER_NEAREST);
    base::PictureCanvas canvas(picture);
    const double left = area.x, bottom = area.br().y;
    for (const auto& [depth, x, label] :
         table_ticks({0, .1, .5, 1, 2, 4}, axes.deepest_mm, table.cols, left, area.width, text_extent, 10))
    {
        canvas.line({x, bottom}, {x, bottom + tick}, {});
        canvas.text({x, bottom + 18}, label, {.height = text, .anchor = base::Anchor::Middle});
    }
    canvas.text({left + area.width / 2., bottom + 38}, "depth of the injury, mm",
                {.height = text, .anchor = base::Anchor::Middle});
    for (const auto& [day, y, label] : table_ticks(
             {0, 1, 3, 7, 14, 30, 60, 120, 365, 1000}, axes.last_day, table.rows, area.y, area.height,
             [](const std::string&) { return text; }, 4))
    {
        canvas.line({left - tick, y}, {left, y}, {});
        canvas.text({left - 9, y + text / 2}, label, {.height = text, .anchor = base::Anchor::End});
    }
}

} // namespace

cv::Mat3b draw_tables(const std::string& title, const std::vector<std::pair<std::string, cv::Mat3f>>& tables,
                      const shared::LutAxes& axes)
{
    constexpr int side = 320, left = 60, top = 66, bottom = 60, gap = 60;
    const int count = static_cast<int>(tables.size());
    cv::Mat3b picture = blank(top + side + bottom, std::max(left + count * (side + gap),
                                                            int(base::text_width(title, heading)) + 16));
    base::draw_text(picture, title, {8, 22}, {.height = heading});
    for (int i = 0; i < count; ++i) {
        const auto& [name, table] = tables[static_cast<std::size_t>(i)];
        const cv::Rect area(left + i * (side + gap), top, side, side);
        base::draw_text(picture, name, {area.x, top - 14}, {.height = heading});
        draw_table(picture, area, table, axes);
    }
    base::draw_text(picture, "day", {8, top - 14}, {.height = text});
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
    cv::Mat3b picture = blank(top + static_cast<int>(rows.size()) * (height + 8),
                              std::max(x.back() + width + 10, int(base::text_width(title, heading)) + 20));
    const base::TextStyle centered{.height = text, .anchor = base::Anchor::Middle};
    base::draw_text(picture, title, {10, 22}, {.height = heading});
    base::draw_text(picture, "day", {10, 50}, {.height = text});
    for (std::size_t i = 0; i < days.size(); ++i)
        base::draw_text(picture, fmt::format("{:g}", days[i]), {x[i] + width / 2, 50}, centered);
    base::PictureCanvas canvas(picture);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const int y = top + static_cast<int>(r) * (height + 8);
        base::draw_text(picture, rows[r].name, {10, y + height / 2 - 5});
        base::draw_text(picture, rows[r].detail, {10, y + height / 2 + 14}, {.height = text});
        for (std::size_t i = 0; i < rows[r].colors.size(); ++i) {
            const cv::Rect place(x[i], y, width, height);
            canvas.rect(place, {base::palette::grid}); // a frame makes white swatches visible
            const cv::Rect inner(place.x + 1, place.y + 1, width - 2, height - 2);
            const auto& color = rows[r].colors[i];
            canvas.rect(inner, {color ? base::paint(base::srgb8_from_linear(*color)) : base::palette::white});
            if (!color)
                base::draw_text(picture, "closed", {x[i] + width / 2, y + height / 2 + 4}, centered);
        }
    }
    return picture;
}

} // namespace bake_command
