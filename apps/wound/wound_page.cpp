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
#include "wound/pictures.hpp"
#include "wound/warp/warp.hpp"

namespace wound_command {

namespace {

constexpr int tile_side = 264, gap_px = 8, column_count = 6, title_height = 24; // pixels
constexpr int page_width = column_count * (tile_side + gap_px) + gap_px;
constexpr int charts_height = 330;
constexpr std::array shown_ratios{1., .8, .6, .4, .2, .05};
constexpr double shown_ratio = .4; // r of the displacements and the grid (the paper's Figure 4)
constexpr base::Paint paper = base::palette::white;

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

base::Chart ratio_chart(const wound::Healing& healing)
{
    const double last = std::min(1.3 * wound::closure_day(healing.curve), 365.);
    base::Series depth{.legend = "depth, sqrt r", .paint = base::palette::rest, .line_width = 1};
    base::Series border{.legend = "area inside the border", .paint = wound::border_paint, .line_width = 2};
    base::Series bed{.legend = "open bed, r", .paint = wound::point_paint, .line_width = 2};
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
        put(page, wound::photograph_with_mask(photograph, wound), 0, column++, "photograph, mask, patch");
    put(page, wound::displacements(color, wound, shown_ratio), 0, column++,
        fmt::format("{} control points, r = {}", wound.control_points.size(), shown_ratio));
    put(page, wound::warped_grid(shown, wound), 0, column++,
        fmt::format("skin's grid at r = {}", shown_ratio));
    double deepest = 0;
    cv::minMaxLoc(wound.patch.depth_mm, nullptr, &deepest);
    put(page, wound::depth_picture(wound.patch.depth_mm), 0, column++,
        fmt::format("depth, at most {:.2f} mm", deepest));
    cv::Mat1b opacity;
    wound.patch.opacity.convertTo(opacity, CV_8U, 255);
    cv::Mat3b opacity_picture;
    cv::cvtColor(opacity, opacity_picture, cv::COLOR_GRAY2RGB);
    put(page, opacity_picture, 0, column, "opacity over the face");
    for (std::size_t i = 0; i < shown_ratios.size(); ++i) {
        const cv::Mat3b warped = wound::warp_image(color, wound::make_warp(wound.flow, shown_ratios[i]));
        put(page, warped, 1, static_cast<int>(i), fmt::format("warped, r = {}", shown_ratios[i]));
        put(page, wound::plainly_scaled(color, shown_ratios[i]), 2, static_cast<int>(i),
            fmt::format("plainly scaled, r = {}", shown_ratios[i]));
    }
    const int top = page.rows - charts_height;
    base::PictureCanvas canvas(page);
    const double closed = std::min(wound::closure_day(healing.curve), 365.);
    const std::array days{0., closed / 4, closed / 2, closed * 3 / 4, closed};
    base::draw_chart(canvas, cv::Rect(0, top, page_width / 2, charts_height),
                     wound::depth_profiles(wound, healing, days));
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
