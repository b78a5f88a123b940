#include "apps/wound/wound_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "base/chart.hpp"
#include "base/color.hpp"
#include "base/draw_text.hpp"
#include "wound/contour.hpp"
#include "wound/depth.hpp"
#include "wound/warp/warp.hpp"

namespace wound_command {

namespace {

constexpr int tile_side = 264, gap_px = 8, column_count = 6, title_height = 24; // pixels
constexpr int page_width = column_count * (tile_side + gap_px) + gap_px;
constexpr int charts_height = 330;
constexpr std::array shown_ratios{1., .8, .6, .4, .2, .05};
constexpr double shown_ratio = .4; // r of the displacements and the grid (the paper's Figure 4)
constexpr base::Paint paper = base::palette::white, border_paint = base::paint(0x009646),
                      point_paint = base::paint(0xc81e1e), arrow_paint = base::paint(0x143cc8);

/// Position of a tile on the page, px.
cv::Rect tile(int row, int column)
{
    return {gap_px + column * (tile_side + gap_px), title_height + row * (tile_side + title_height + gap_px),
            tile_side, tile_side};
}

void put(cv::Mat3b& page, const cv::Mat3b& picture, int row, int column, const std::string& title)
{
    const cv::Rect place = tile(row, column);
    cv::Mat3b scaled;
    cv::resize(picture, scaled, place.size(), 0, 0,
               picture.cols > tile_side ? cv::INTER_AREA : cv::INTER_LINEAR);
    scaled.copyTo(page(place));
    base::draw_text(page, title, {place.x, place.y - 7});
}

/// Converts patch coordinates (-1..1) to 1/16 pixels of a picture of `size` x `size`.
cv::Point sixteenths(cv::Point2d p, int size)
{
    return {cvRound(((p.x + 1) * size / 2 - .5) * 16), cvRound(((p.y + 1) * size / 2 - .5) * 16)};
}

void outline(cv::Mat3b& picture, const std::vector<cv::Point2d>& curve, base::Paint paint)
{
    std::vector<cv::Point> points;
    for (cv::Point2d p : curve)
        points.push_back(sixteenths(p, picture.cols));
    cv::polylines(picture, std::vector{points}, true, base::scalar_of(paint), 2, cv::LINE_AA, 4);
}

/// The whole photograph in a square, with the mask's outline and the patch's frame and centre.
cv::Mat3b photograph_with_mask(const wound::Photograph& photograph, const wound::PreparedWound& wound)
{
    const int side = std::max(photograph.srgb.cols, photograph.srgb.rows);
    cv::Mat3b square(side, side, base::rgb_of(paper));
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

/// Figure 1: the border, the control points at distance D_n from the centroid, and their displacements
/// d_n = D_n (1 - sqrt r).
cv::Mat3b displacements(const cv::Mat3b& color, const wound::PreparedWound& wound)
{
    cv::Mat3b picture = color.clone();
    outline(picture, wound.border, border_paint);
    for (cv::Point2d from : wound.control_points) {
        const cv::Point2d to = from - (from - wound.centroid) * (1 - std::sqrt(shown_ratio));
        cv::line(picture, sixteenths(from, picture.cols), sixteenths(to, picture.cols),
                 base::scalar_of(arrow_paint), 1, cv::LINE_AA, 4);
        cv::circle(picture, sixteenths(from, picture.cols), 4 * 16, base::scalar_of(point_paint), cv::FILLED,
                   cv::LINE_AA, 4);
    }
    cv::circle(picture, sixteenths(wound.centroid, picture.cols), 6 * 16, base::scalar_of(point_paint), 2,
               cv::LINE_AA, 4);
    return picture;
}

/// A square grid drawn on the skin on day 0 after the warp, and the warped border.
cv::Mat3b warped_grid(const wound::Warp& warp, const wound::PreparedWound& wound)
{
    constexpr int map_size = 528;
    constexpr double lines = 12; // per patch unit (half the patch width)
    const cv::Mat2d back = wound::backward_map(warp, map_size);
    cv::Mat3b picture(map_size, map_size, base::rgb_of(paper));
    const auto cell = [&](int j, int i, int axis) { return std::floor(back(j, i)[axis] * lines); };
    for (int j = 0; j + 1 < map_size; ++j)
        for (int i = 0; i + 1 < map_size; ++i)
            for (int axis : {0, 1})
                if (cell(j, i, axis) != cell(j, i + 1, axis) || cell(j, i, axis) != cell(j + 1, i, axis))
                    picture(j, i) = cv::Vec3b(70, 70, 70);
    std::vector<cv::Point2d> today;
    for (cv::Point2d p : wound.border)
        today.push_back(wound.centroid + (p - wound.centroid) * warp.scale);
    outline(picture, today, border_paint);
    return picture;
}

/// The alternative in Figure 4 (a): the whole picture scaled by sqrt(ratio) about its centre.
cv::Mat3b plainly_scaled(const cv::Mat3b& color, double ratio)
{
    const double scale = std::sqrt(ratio), middle = (color.cols - 1) / 2.;
    cv::Mat3b scaled;
    cv::warpAffine(color, scaled, cv::Matx23d(scale, 0, middle * (1 - scale), 0, scale, middle * (1 - scale)),
                   color.size(), cv::INTER_AREA, cv::BORDER_CONSTANT, base::scalar_of(paper));
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

/// Figure 5: depth along the line through the centroid, on several days.
base::Chart profile_chart(const wound::PreparedWound& wound, const wound::Healing& healing)
{
    double lowest = 0, deepest = 0;
    cv::minMaxLoc(wound.patch.depth_mm, &lowest, &deepest);
    const double half = wound.patch.width_mm / 2;
    base::Chart chart{.x = {.title = "along the skin", .unit = "mm", .low = -half, .high = half},
                      .y = {.title = "height over the skin through the centroid",
                            .unit = "mm",
                            .low = -1.1 * deepest - .1,
                            .high = -lowest + .3}};
    const double closed = std::min(wound::closure_day(healing.curve), 365.);
    for (int k = 0; k < 5; ++k) {
        const double day = closed * k / 4;
        const wound::HealingState state = wound::healing_at(healing, day);
        const cv::Mat1f today =
            wound::warp_image(wound.patch.depth_mm, wound::make_warp(wound.flow, state.unhealed_ratio));
        const std::vector<double> profile = wound::depth_profile(today, wound.centroid);
        const cv::Vec3b color(uchar(200 - 40 * k), uchar(40 + 30 * k), uchar(40 + 45 * k));
        base::Series line{
            .legend = fmt::format("day {:.0f}", day), .paint = base::paint(color), .line_width = 2};
        for (std::size_t i = 0; i < profile.size(); ++i) {
            const double share = (static_cast<double>(i) + .5) / static_cast<double>(profile.size());
            line.points.emplace_back((share * 2 - 1) * half, -profile[i] * state.depth_scale);
        }
        chart.series.push_back(std::move(line));
    }
    return chart;
}

base::Chart ratio_chart(const wound::Healing& healing)
{
    const double last = std::min(1.3 * wound::closure_day(healing.curve), 365.);
    base::Series depth{.legend = "depth, sqrt r", .paint = base::palette::rest, .line_width = 1};
    base::Series border{.legend = "area inside the border", .paint = border_paint, .line_width = 2};
    base::Series bed{.legend = "open bed, r", .paint = point_paint, .line_width = 2};
    double highest = 1;
    for (int i = 0; i <= 300; ++i) {
        const wound::HealingState state = wound::healing_at(healing, last * i / 300);
        bed.points.emplace_back(state.day, state.unhealed_ratio);
        border.points.emplace_back(state.day, state.border_ratio);
        depth.points.emplace_back(state.day, state.depth_scale);
        highest = std::max(highest, state.border_ratio);
    }
    return {.x = {.title = "time", .unit = "days", .low = 0, .high = last},
            .y = {.title = "share of day 0", .low = 0, .high = 1.08 * highest},
            .series = {depth, border, bed}};
}

} // namespace

cv::Mat3b draw_wound_page(const wound::Photograph& photograph, const wound::PreparedWound& wound,
                          const wound::Healing& healing)
{
    cv::Mat3b page(title_height + 3 * (tile_side + title_height + gap_px) + charts_height, page_width,
                   base::rgb_of(paper));
    const cv::Mat3b color = base::srgb_from_linear(wound.patch.color);
    const wound::Warp shown = wound::make_warp(wound.flow, shown_ratio);
    int column = 0;
    if (!wound.photo_mask.empty())
        put(page, photograph_with_mask(photograph, wound), 0, column++, "photograph, mask, patch");
    put(page, displacements(color, wound), 0, column++,
        fmt::format("{} control points, r = {}", wound.control_points.size(), shown_ratio));
    put(page, warped_grid(shown, wound), 0, column++, fmt::format("skin's grid at r = {}", shown_ratio));
    double deepest = 0;
    cv::minMaxLoc(wound.patch.depth_mm, nullptr, &deepest);
    put(page, depth_picture(wound.patch.depth_mm), 0, column++,
        fmt::format("depth, at most {:.2f} mm", deepest));
    cv::Mat1b opacity;
    wound.patch.opacity.convertTo(opacity, CV_8U, 255);
    cv::Mat3b opacity_picture;
    cv::cvtColor(opacity, opacity_picture, cv::COLOR_GRAY2RGB);
    put(page, opacity_picture, 0, column, "opacity over the face");
    for (std::size_t i = 0; i < shown_ratios.size(); ++i) {
        const cv::Mat3b warped = wound::warp_image(color, wound::make_warp(wound.flow, shown_ratios[i]));
        put(page, warped, 1, static_cast<int>(i), fmt::format("warped, r = {}", shown_ratios[i]));
        put(page, plainly_scaled(color, shown_ratios[i]), 2, static_cast<int>(i),
            fmt::format("plainly scaled, r = {}", shown_ratios[i]));
    }
    const int top = page.rows - charts_height;
    base::PictureCanvas canvas(page);
    base::draw_chart(canvas, cv::Rect(0, top, page_width / 2, charts_height), profile_chart(wound, healing));
    base::draw_chart(canvas, cv::Rect(page_width / 2, top, page_width / 2, charts_height),
                     ratio_chart(healing));
    return page;
}

nlohmann::json wound_to_json(const wound::PreparedWound& wound, const wound::Healing& healing)
{
    const double pixels = wound.photo_side / 2; // of the photograph, per patch unit
    const auto in_photo = [&](cv::Point2d p) {
        const cv::Point2d q = wound.photo_center + p * pixels;
        return nlohmann::json{q.x, q.y};
    };
    nlohmann::json points = nlohmann::json::array(), border = nlohmann::json::array(),
                   warps = nlohmann::json::array(), days = nlohmann::json::array();
    for (cv::Point2d p : wound.control_points)
        points.push_back(in_photo(p));
    for (cv::Point2d p : wound.border)
        border.push_back(in_photo(p));
    int folds = 0;
    for (double r : {1., .9, .8, .6, .4, .2, .1, .05, .01}) {
        const wound::Warp warp = wound::make_warp(wound.flow, r);
        const wound::FoldCheck check = wound::check_folds(warp, wound.patch.mask.cols);
        const double area =
            wound::signed_area(wound::outline_today(warp, wound.border)); // a mask may miss a small wound
        folds += check.folded_texels;
        warps.push_back({{"ratio", r},
                         {"area_ratio", area / wound::signed_area(wound.border)},
                         {"folds", check.folded_texels},
                         {"least_jacobian", check.least_jacobian}});
    }
    const double closed = wound::closure_day(healing.curve);
    const int last = static_cast<int>(std::ceil(std::min(1.3 * closed, 365.)));
    for (int day = 0; day <= last; ++day) {
        const wound::HealingState state = wound::healing_at(healing, day);
        days.push_back({{"day", day},
                        {"unhealed_ratio", state.unhealed_ratio},
                        {"border_ratio", state.border_ratio},
                        {"depth_scale", state.depth_scale}});
    }
    double lowest = 0, deepest = 0;
    cv::minMaxLoc(wound.patch.depth_mm, &lowest, &deepest);
    nlohmann::json json{{"area_px", wound.area * pixels * pixels},
                        {"centroid_px", in_photo(wound.centroid)},
                        {"control_points", points},
                        {"border_px", border},
                        {"patch_side_px", wound.photo_side},
                        {"patch_width_mm", wound.patch.width_mm},
                        {"area_mm2", wound.area * std::pow(wound.patch.width_mm / 2, 2)},
                        {"shows_skin", wound.patch.shows_skin},
                        {"depth_mm_max", deepest},
                        {"rim_mm_max", -lowest},
                        {"folds", folds},
                        {"warps", warps},
                        {"half_time_days", nullptr},
                        {"closure_day", nullptr},
                        {"days", days}};
    if (std::isfinite(closed))
        json["closure_day"] = closed;
    if (const double half = wound::half_time(healing.curve); std::isfinite(half))
        json["half_time_days"] = half;
    return json;
}

} // namespace wound_command
