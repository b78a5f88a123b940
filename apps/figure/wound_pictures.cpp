#include "apps/figure/wound_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "apps/figure/figures.hpp"
#include "base/chart.hpp"
#include "base/color.hpp"
#include "head/albedo_under.hpp"
#include "wound/optics/chromophores.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/pictures.hpp"

namespace figure_command {
namespace {

constexpr double contracted = .4;      // r of Figure 4
constexpr double shown_spacing = .075; // of the lines that give the control points, patch units
constexpr wound::WarpModel paper_warp = wound::WarpModel::Dense; // one step of radial basis functions

/// The wound with fewer control points than the program takes, so that a picture shows each of them.
wound::PreparedWound with_few_points(wound::PreparedWound wound)
{
    wound.control_points = wound::control_points(wound.border, wound.centroid, shown_spacing);
    wound.flow = wound::prepare_flow(wound.border, wound.control_points, wound.centroid);
    return wound;
}

/// The fresh wound on the face's skin, the whole patch.
cv::Mat3b fresh_wound(const scene::LoadedScene& loaded)
{
    return base::srgb_from_linear(recovering_colors(loaded, Equations::Published, {0}).front().color);
}

/// The middle of a patch's picture, which the wound fills.
cv::Mat3b middle_of(const cv::Mat3b& patch)
{
    const int margin = patch.cols * 3 / 20;
    return patch(cv::Rect(margin, margin, patch.cols - 2 * margin, patch.rows - 2 * margin));
}

cv::Mat3b with_chart_below(const cv::Mat3b& sheet, const base::Chart& chart, int height)
{
    cv::Mat3b page(sheet.rows + height, sheet.cols, base::rgb_of(base::palette::paper));
    sheet.copyTo(page(cv::Rect(cv::Point(), sheet.size())));
    base::PictureCanvas canvas(page);
    base::draw_chart(canvas, cv::Rect(0, sheet.rows, sheet.cols, height), chart);
    return page;
}

} // namespace

// ---- Figure 1 ------------------------------------------------------------------------------------------

void draw_control_points(Workbench& bench)
{
    const scene::LoadedScene& loaded = bench.cheek();
    const scene::PlacedWound& placed = loaded.wounds.front();
    const wound::PreparedWound prepared = with_few_points(placed.prepared());
    const wound::Photograph photograph = scene::read_photograph(loaded.scene.wounds.front());
    const std::vector<RecoveringColor> stages =
        recovering_colors(loaded, Equations::Published, {0, 1 - contracted});
    const cv::Mat3b color = base::srgb_from_linear(stages[0].color);
    const wound::Warp warp = wound::make_warp(prepared.flow, contracted, paper_warp);
    const double day = wound::day_below(placed.healing.curve, contracted),
                 depth_scale = wound::healing_at(placed.healing, day).depth_scale;
    const cv::Mat1f depth = wound::warp_image(prepared.patch.depth_mm, warp) * depth_scale;
    double deepest = 0;
    cv::minMaxLoc(depth, nullptr, &deepest);
    const cv::Mat3f reflectance = wound::warp_image(stages[1].reflectance, warp);

    const stage::Stage& stage = bench.showing(loaded.scene);
    const std::vector<base::SheetCell> cells{
        bench.cell(wound::photograph_with_mask(photograph, prepared), "photograph, segmented"),
        bench.cell(color, "(a) on the face's skin"),
        bench.cell(wound::control_lines(color, prepared, shown_spacing),
                   fmt::format("(b) {} control points", prepared.control_points.size())),
        bench.cell(wound::displacements(color, prepared, contracted), "(c) moved by d = D (1 - sqrt r)"),
        bench.cell(wound::warp_image(color, warp), fmt::format("(d) warped, r = {:g}", contracted)),
        bench.cell(wound::depth_picture(depth), fmt::format("depth, at most {:.2f} mm", deepest)),
        bench.cell(base::srgb_from_linear(reflectance), "reflectance R(d), eq. (3)"),
        bench.cell(bench.picture(stage, stage.loaded().close_up(0), day),
                   fmt::format("shaded, eq. (8), day {:.1f}", day))};
    bench.write_picture("figure_1",
                        base::contact_sheet("From the photograph to the face, as published", cells, 4));
    bench.say(fmt::format("{} control points, so that each is seen; the program takes {} for this wound",
                          prepared.control_points.size(), placed.prepared().control_points.size()));
}

// ---- Figure 4 ------------------------------------------------------------------------------------------

double warped_area_ratio(const wound::PreparedWound& wound, const wound::Warp& warp)
{
    return cv::sum(wound::warp_image(wound.patch.mask, warp))[0] / cv::sum(wound.patch.mask)[0];
}

void draw_contraction(Workbench& bench)
{
    const wound::PreparedWound prepared = with_few_points(bench.cheek().wounds.front().prepared());
    const wound::Warp warp = wound::make_warp(prepared.flow, contracted, paper_warp);
    const cv::Mat3b color = fresh_wound(bench.cheek());
    const auto marked = [&](cv::Mat3b picture, double scale) {
        const auto scaled = [&](wound::Polyline points) {
            for (cv::Point2d& p : points)
                p = prepared.centroid + (p - prepared.centroid) * scale;
            return points;
        };
        wound::draw_outline(picture, scaled(prepared.border));
        wound::draw_points(picture, scaled(prepared.control_points));
        return picture;
    };
    const std::vector<base::SheetCell> cells{
        bench.cell(color, "day 0"),
        bench.cell(wound::plainly_scaled(color, contracted), "(a) image scaling"),
        bench.cell(wound::warp_image(color, warp), "(b) weighted warp"),
        bench.cell(marked(color.clone(), 1), "border, control points"),
        bench.cell(marked(wound::plainly_scaled(color, contracted), warp.scale), "(a): all skin shrinks"),
        bench.cell(wound::warped_grid(warp, prepared), "(b): the skin is pulled")};
    bench.write_picture("figure_4",
                        base::contact_sheet(fmt::format("Contracted to r = {:g}", contracted), cells, 3));
    bench.say(
        fmt::format("area of the warped mask / area of the mask: {:.4f}", warped_area_ratio(prepared, warp)));
}

// ---- Figure 5 ------------------------------------------------------------------------------------------

base::Chart deepest_chart(const base::Chart& profiles, const std::vector<double>& days,
                          const wound::Healing& healing)
{
    base::Series measured{.legend = "deepest point of the profile", .radius = 4},
        expected{.legend = "depth on day 0 x sqrt r", .paint = base::series_paint(1), .line_width = 2};
    for (std::size_t i = 0; i < days.size(); ++i) {
        double deepest = 0;
        for (const cv::Point2d& p : profiles.series[i].points)
            deepest = std::max(deepest, -p.y);
        measured.points.emplace_back(days[i], deepest);
    }
    const double last = days.back(), depth0 = measured.points.front().y;
    for (int i = 0; i <= 100; ++i)
        expected.points.emplace_back(last * i / 100,
                                     depth0 * wound::healing_at(healing, last * i / 100).depth_scale);
    return {.title = "Deepest point over the days",
            .x = {.title = "time", .unit = "days", .low = 0, .high = last},
            .y = {.title = "depth", .unit = "mm", .low = 0, .high = 1.1 * depth0},
            .series = {expected, measured}};
}

void draw_depth(Workbench& bench)
{
    const scene::PlacedWound& placed = bench.cheek().wounds.front();
    const std::vector<double> days{0, 3, 6, 9, 12, 18, 24, 30};
    base::Chart profiles = wound::depth_profiles(placed.prepared(), placed.healing, days);
    profiles.title = "Across the wound's centroid, day by day";
    const base::Chart deepest = deepest_chart(profiles, days, placed.healing);
    bench.write_drawing("figure_5", {940, 380}, "The wound's depth by day", [&](base::Canvas& canvas) {
        base::draw_chart(canvas, {0, 0, 540, 380}, profiles);
        base::draw_chart(canvas, {540, 0, 400, 380}, deepest);
    });
}

// ---- Figure 6 ------------------------------------------------------------------------------------------

namespace {

struct Tissue
{
    optics::HealingTissue tissue;
    optics::ReflectanceModel model;
    optics::BlendModel blend;
};

Tissue tissue_of(Equations equations)
{
    if (equations == Equations::Published)
        return {*optics::healing_tissue_named("table1"), optics::ReflectanceModel::Published, optics::BlendModel::Published};
    const scene::Scene usual;
    return {optics::healing_tissue_or_file(usual.tissue), usual.reflectance_model, usual.shading.blend_model};
}

/// R over the depth of the injury, for one day of healing.
class ReflectanceByDepth
{
  public:
    ReflectanceByDepth(const optics::TissueDay& day, optics::ReflectanceModel model, double deepest_mm)
        : per_mm_(steps / std::max(deepest_mm, 1e-6))
    {
        for (int i = 0; i <= steps; ++i)
            colors_.push_back(optics::tissue_color(optics::layers_at(day, i / per_mm_, optics::is_the_papers(model)), model));
    }
    base::Color at(double depth_mm) const
    {
        const double x = std::clamp(depth_mm * per_mm_, 0., steps - 1e-9), share = x - std::floor(x);
        return (1 - share) * colors_[std::size_t(x)] + share * colors_[std::size_t(x) + 1];
    }

  private:
    static constexpr int steps = 64;
    double per_mm_;
    std::vector<base::Color> colors_;
};

/// The face's skin under the patch; the patch's own colour where the patch hangs over the edge of the head.
cv::Mat3f skin_under(const scene::LoadedScene& loaded, const scene::PlacedWound& placed)
{
    const cv::Mat3f& patch = placed.prepared().patch.color;
    cv::Mat3f skin = head::albedo_under(*loaded.head->model, loaded.head->skin, placed.anchor, patch.cols);
    for (int y = 0; y < skin.rows; ++y)
        for (int x = 0; x < skin.cols; ++x)
            if (std::isnan(skin(y, x)[0]))
                skin(y, x) = patch(y, x);
    return skin;
}

base::Color mean_in_bed(const cv::Mat3f& color, const wound::Patch& patch)
{
    const cv::Scalar mean = cv::mean(color, patch.mask > .5F);
    return {mean[0], mean[1], mean[2]};
}

} // namespace

std::vector<RecoveringColor> recovering_colors(const scene::LoadedScene& loaded, Equations equations,
                                               const std::vector<double>& recoveries)
{
    const Tissue tissue = tissue_of(equations);
    const scene::PlacedWound& placed = loaded.wounds.front();
    const wound::Patch& patch = placed.prepared().patch;
    const cv::Mat3f skin = skin_under(loaded, placed);
    double deepest = 0;
    cv::minMaxLoc(patch.depth_mm, nullptr, &deepest);
    const optics::HealingTissue here = wound::at_place(tissue.tissue, placed.fitted().thickness);
    std::vector<RecoveringColor> all;
    for (const double recovery : recoveries) {
        const double left = std::max(1 - recovery, wound::closed_ratio),
                     day = wound::day_below(placed.healing.curve, left);
        const ReflectanceByDepth reflectance(optics::open_bed(here, day, std::sqrt(1 - recovery)),
                                             tissue.model, deepest);
        RecoveringColor now{recovery, cv::Mat3f(skin.size()), cv::Mat3f(skin.size())};
        for (int y = 0; y < skin.rows; ++y)
            for (int x = 0; x < skin.cols; ++x) {
                const base::Color r = reflectance.at(patch.depth_mm(y, x)), own = skin(y, x),
                                  blended = optics::blend(tissue.blend, base::Color(patch.color(y, x)), r,
                                                          own, recovery);
                now.reflectance(y, x) = r;
                now.color(y, x) = own + double(patch.opacity(y, x)) * (blended - own);
            }
        now.to_skin = base::delta_e2000(base::lab_from_linear(mean_in_bed(now.color, patch)),
                                        base::lab_from_linear(mean_in_bed(skin, patch)));
        all.push_back(std::move(now));
    }
    return all;
}

void draw_recovery(Workbench& bench)
{
    const std::vector<double> recoveries{0, .1, .2, .3, .4, .5, .6, .7, .8, .9, 1};
    base::Chart chart{.x = {.title = "recovery r of eq. (4)", .low = 0, .high = 1},
                      .y = {.title = "bed's mean to the skin's, CIEDE2000", .low = 0}};
    std::vector<base::SheetCell> cells;
    for (const Equations equations : {Equations::Published, Equations::Corrected}) {
        const bool published = equations == Equations::Published;
        base::Series line{.legend = published ? "as printed" : "our default",
                          .paint = base::series_paint(published ? 0 : 1),
                          .line_width = 2,
                          .radius = 3};
        const std::vector<RecoveringColor> colors = recovering_colors(bench.cheek(), equations, recoveries);
        for (std::size_t i = 0; i < colors.size(); ++i) {
            line.points.emplace_back(colors[i].recovery, colors[i].to_skin);
            if (i % 2 == 0)
                cells.push_back(bench.cell(
                    middle_of(base::srgb_from_linear(colors[i].color)),
                    fmt::format("{}, r = {:g}", published ? "as printed" : "default", colors[i].recovery)));
        }
        bench.say(fmt::format("{}: {:.1f} CIEDE2000 from the skin at r = 0, {:.1f} at r = 1", line.legend,
                              line.points.front().y, line.points.back().y));
        chart.series.push_back(std::move(line));
    }
    bench.write_picture(
        "figure_6",
        with_chart_below(base::contact_sheet("Eq. (4): the colour alone recovers", cells, 6), chart, 260));
}

} // namespace figure_command
