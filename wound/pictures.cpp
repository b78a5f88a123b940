#include "wound/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "wound/contour.hpp"
#include "wound/depth.hpp"

namespace wound {

namespace {

/// Converts patch coordinates (-1..1) to 1/16 pixels of a picture of `size` x `size`.
cv::Point sixteenths(cv::Point2d p, int size)
{
    return {cvRound(((p.x + 1) * size / 2 - .5) * 16), cvRound(((p.y + 1) * size / 2 - .5) * 16)};
}

void draw_segment(cv::Mat3b& picture, cv::Point2d from, cv::Point2d to, base::Paint paint)
{
    cv::line(picture, sixteenths(from, picture.cols), sixteenths(to, picture.cols), base::scalar_of(paint), 1,
             cv::LINE_AA, 4);
}

void draw_centroid(cv::Mat3b& picture, cv::Point2d centroid)
{
    cv::circle(picture, sixteenths(centroid, picture.cols), 6 * 16, base::scalar_of(point_paint), 2,
               cv::LINE_AA, 4);
}

} // namespace

cv::Mat3b photograph_with_mask(const Photograph& photograph, const PreparedWound& wound)
{
    const int side = std::max(photograph.srgb.cols, photograph.srgb.rows);
    cv::Mat3b square(side, side, base::rgb_of(base::palette::white));
    photograph.srgb.copyTo(square(cv::Rect(cv::Point(), photograph.srgb.size())));
    const int thickness = std::max(1, side / 200);
    std::vector<std::vector<cv::Point>> curves;
    cv::findContours(wound.photo_mask, curves, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::drawContours(square, curves, -1, base::scalar_of(border_paint), thickness);
    const cv::Point2d half(wound.photo_side / 2, wound.photo_side / 2);
    cv::rectangle(square, cv::Point(wound.photo_center - half), cv::Point(wound.photo_center + half),
                  base::scalar_of(arrow_paint), thickness);
    cv::drawMarker(square, wound.photo_center, base::scalar_of(point_paint), cv::MARKER_CROSS, side / 20,
                   thickness);
    return square;
}

void draw_outline(cv::Mat3b& picture, const Polyline& curve)
{
    std::vector<cv::Point> points;
    for (cv::Point2d p : curve)
        points.push_back(sixteenths(p, picture.cols));
    cv::polylines(picture, std::vector{points}, true, base::scalar_of(border_paint), 2, cv::LINE_AA, 4);
}

void draw_points(cv::Mat3b& picture, const std::vector<cv::Point2d>& points)
{
    for (cv::Point2d p : points)
        cv::circle(picture, sixteenths(p, picture.cols), 4 * 16, base::scalar_of(point_paint), cv::FILLED,
                   cv::LINE_AA, 4);
}

cv::Mat3b control_lines(const cv::Mat3b& color, const PreparedWound& wound, double spacing)
{
    cv::Mat3b picture = color.clone();
    const int most = int(1 / spacing);
    for (int k = -most; k <= most; ++k) {
        const double x = wound.centroid.x + k * spacing, y = wound.centroid.y + k * spacing;
        draw_segment(picture, {x, -1}, {x, 1}, base::palette::grid);
        draw_segment(picture, {-1, y}, {1, y}, base::palette::grid);
    }
    draw_outline(picture, wound.border);
    draw_points(picture, wound.control_points);
    draw_centroid(picture, wound.centroid);
    return picture;
}

cv::Mat3b displacements(const cv::Mat3b& color, const PreparedWound& wound, double area_ratio)
{
    cv::Mat3b picture = color.clone();
    draw_outline(picture, wound.border);
    for (cv::Point2d from : wound.control_points)
        draw_segment(picture, from, from - (from - wound.centroid) * (1 - std::sqrt(area_ratio)),
                     arrow_paint);
    draw_points(picture, wound.control_points);
    draw_centroid(picture, wound.centroid);
    return picture;
}

cv::Mat3b warped_grid(const Warp& warp, const PreparedWound& wound)
{
    constexpr int map_size = 528;
    constexpr double lines = 12; // per patch unit (half the patch width)
    const cv::Mat2d back = backward_map(warp, map_size);
    cv::Mat3b picture(map_size, map_size, base::rgb_of(base::palette::white));
    const auto cell = [&](int j, int i, int axis) { return std::floor(back(j, i)[axis] * lines); };
    for (int j = 0; j + 1 < map_size; ++j)
        for (int i = 0; i + 1 < map_size; ++i)
            for (int axis : {0, 1})
                if (cell(j, i, axis) != cell(j, i + 1, axis) || cell(j, i, axis) != cell(j + 1, i, axis))
                    picture(j, i) = cv::Vec3b(70, 70, 70);
    std::vector<cv::Point2d> today;
    for (cv::Point2d p : wound.border)
        today.push_back(wound.centroid + (p - wound.centroid) * warp.scale);
    draw_outline(picture, today);
    return picture;
}

cv::Mat3b plainly_scaled(const cv::Mat3b& color, double area_ratio)
{
    const double scale = std::sqrt(area_ratio), middle = (color.cols - 1) / 2.;
    cv::Mat3b scaled;
    cv::warpAffine(color, scaled, cv::Matx23d(scale, 0, middle * (1 - scale), 0, scale, middle * (1 - scale)),
                   color.size(), cv::INTER_AREA, cv::BORDER_CONSTANT, base::scalar_of(base::palette::white));
    return scaled;
}

cv::Mat3b depth_picture(const cv::Mat1f& depth_mm)
{
    double lowest = 0, highest = 0;
    cv::minMaxLoc(depth_mm, &lowest, &highest);
    cv::Mat1b gray;
    depth_mm.convertTo(gray, CV_8U, -215 / std::max(highest - lowest, 1e-6),
                       20 + 215 * highest / std::max(highest - lowest, 1e-6));
    cv::Mat3b picture;
    cv::cvtColor(gray, picture, cv::COLOR_GRAY2RGB);
    return picture;
}

base::Chart depth_profiles(const PreparedWound& wound, const Healing& healing, std::span<const double> days)
{
    double lowest = 0, deepest = 0;
    cv::minMaxLoc(wound.patch.depth_mm, &lowest, &deepest);
    const double half = wound.patch.width_mm / 2;
    base::Chart chart{.x = {.title = "along the skin", .unit = "mm", .low = -half, .high = half},
                      .y = {.title = "height over the skin through the centroid",
                            .unit = "mm",
                            .low = -1.1 * deepest - .1,
                            .high = -lowest + .3}};
    for (std::size_t k = 0; k < days.size(); ++k) {
        const HealingState state = healing_at(healing, days[k]);
        const cv::Mat1f today = warp_image(wound.patch.depth_mm, make_warp(wound.flow, state.unhealed_ratio));
        const std::vector<double> profile = depth_profile(today, wound.centroid);
        const double late = double(k) / double(std::max<std::size_t>(days.size() - 1, 1)); // 0 red .. 1 blue
        const cv::Vec3b color(uchar(200 - 160 * late), uchar(40 + 120 * late), uchar(40 + 180 * late));
        base::Series line{
            .legend = fmt::format("day {:.0f}", days[k]), .paint = base::paint(color), .line_width = 2};
        for (std::size_t i = 0; i < profile.size(); ++i) {
            const double share = (static_cast<double>(i) + .5) / static_cast<double>(profile.size());
            line.points.emplace_back((share * 2 - 1) * half, -profile[i] * state.depth_scale);
        }
        chart.series.push_back(std::move(line));
    }
    return chart;
}

} // namespace wound
