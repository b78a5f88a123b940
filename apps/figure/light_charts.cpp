#include "apps/figure/light_charts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include "apps/figure/figures.hpp"
#include "apps/figure/workbench.hpp"
#include "wound/optics/fresnel.hpp"
#include "wound/optics/reflectance.hpp"

namespace figure_command {
namespace {

namespace palette = base::palette;
constexpr base::Paint backward_paint = base::series_paint(1), forward_paint = base::series_paint(4),
                      bottom_paint = base::series_paint(0);
constexpr std::array channel_names{"red", "green", "blue"};

/// Integral of 2 pi p over cosines, by the midpoint rule.
double share_between(double g, double from, double to)
{
    constexpr int steps = 200'000;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        sum += optics::henyey_greenstein(g, from + (to - from) * (i + .5) / steps);
    return 2 * std::numbers::pi * sum * (to - from) / steps;
}

std::string named(const optics::Layer& layer)
{
    return fmt::format("{}, g = {:g}", layer.name, layer.g);
}

} // namespace

// ---- Figure 2 ------------------------------------------------------------------------------------------

Halves integrated_halves(double g)
{
    return {share_between(g, 0, 1), share_between(g, -1, 0)};
}

base::Chart phase_function_chart()
{
    base::Chart chart{.title = "(a) phase function p",
                      .x = {.title = "angle of deflection", .unit = "degrees", .low = 0, .high = 180},
                      .y = {.title = "p", .unit = "1/sr", .logarithmic = true},
                      .references = {{base::ReferenceLine::Along::Y, 90, "forward | backward"}}};
    const optics::SkinLayers skin = optics::table1();
    for (std::size_t i = 0; i < skin.layers.size(); ++i) {
        base::Series line{.legend = named(skin.layers[i]), .paint = base::series_paint(i), .line_width = 2};
        for (int degrees = 0; degrees <= 180; degrees += 2)
            line.points.emplace_back(
                degrees,
                optics::henyey_greenstein(skin.layers[i].g, std::cos(degrees * std::numbers::pi / 180)));
        chart.series.push_back(std::move(line));
    }
    return chart;
}

base::Chart halves_chart()
{
    base::Chart chart{.title = "(b) its integral over each half",
                      .x = {.title = "share of the scattered light", .low = 0, .high = 1.75},
                      .legend = {{"forward", forward_paint}, {"backward, P(g)", backward_paint}}};
    for (const optics::Layer& layer : optics::table1().layers) {
        const Halves halves = integrated_halves(layer.g);
        const double row = double(chart.y.rows.size());
        chart.y.rows.push_back(named(layer));
        chart.bars.push_back({.row = row, .from = 0, .to = halves.forward, .paint = forward_paint});
        chart.bars.push_back({.row = row,
                              .from = halves.forward,
                              .to = halves.forward + halves.backward,
                              .paint = backward_paint,
                              .label = fmt::format("{:.4f} + {:.4f}", halves.forward, halves.backward)});
    }
    return chart;
}

void draw_phase_function(Workbench& bench)
{
    bench.write_drawing("figure_2", {940, 380}, "The phase function and its halves",
                        [](base::Canvas& canvas) {
                            base::draw_chart(canvas, {0, 0, 470, 380}, phase_function_chart());
                            base::draw_chart(canvas, {470, 0, 470, 260}, halves_chart());
                        });
    for (const optics::Layer& layer : optics::table1().layers)
        bench.say(fmt::format("{}: forward {:.6f}, backward {:.6f}; P(g) in closed form {:.6f}", named(layer),
                              integrated_halves(layer.g).forward, integrated_halves(layer.g).backward,
                              optics::backward_fraction(layer.g)));
}

// ---- Figure 3 ------------------------------------------------------------------------------------------

std::vector<LayerLight> light_through(const optics::SkinLayers& tissue)
{
    constexpr optics::ReflectanceModel published = optics::ReflectanceModel::Published;
    std::vector<LayerLight> all;
    std::vector<double> arriving(tissue.channels(), 1.);
    for (std::size_t i = 0; i < tissue.layers.size(); ++i) {
        const optics::Layer& layer = tissue.layers[i];
        const double below = i + 1 < tissue.layers.size() ? tissue.layers[i + 1].n : tissue.n_below;
        LayerLight light{.name = layer.name, .thickness_mm = layer.thickness_mm, .n = layer.n, .g = layer.g};
        light.arriving = arriving;
        light.outside.assign(tissue.channels(), false);
        for (std::size_t c = 0; c < tissue.channels(); ++c) {
            // Within a medium of the layer's own index no boundary reflects: R is the integral of (3) alone.
            const std::vector one{tissue.channel(c).layers[i]};
            const optics::Response inside = optics::reflectance({one, layer.n, layer.n}, published),
                                   whole = optics::reflectance({one, layer.n, below}, published);
            light.scattered.push_back(inside.r);
            light.bottom.push_back(whole.r - inside.r);
            light.transmitted.push_back(whole.t);
            arriving[c] *= whole.t;
        }
        all.push_back(std::move(light));
    }
    for (const optics::OutsideDomain& outside : optics::outside_domain(tissue))
        all[outside.layer].outside[outside.channel] = true;
    return all;
}

namespace {

void draw_arrow(base::Canvas& canvas, cv::Point2d from, cv::Point2d to, base::Paint paint, double width = 2)
{
    const cv::Point2d along = (to - from) / cv::norm(to - from), across(-along.y, along.x);
    canvas.line(from, to - 6 * along, {paint, width});
    canvas.polygon({to, to - 9 * along + 4 * across, to - 9 * along - 4 * across}, {paint});
}

/// One line of numbers, one per channel, right-aligned in columns.
void draw_numbers(base::Canvas& canvas, cv::Point2d at, const std::string& what,
                  const std::vector<double>& values, base::Paint paint, const std::vector<bool>& marked = {})
{
    canvas.text(at, what, {.paint = paint, .height = 9});
    for (std::size_t c = 0; c < values.size(); ++c)
        canvas.text(at + cv::Point2d(178 + 70 * double(c), 0),
                    fmt::format("{:.3f}{}", values[c], !marked.empty() && marked[c] ? "*" : ""),
                    {.height = 9, .anchor = base::Anchor::End});
}

void draw_channel_names(base::Canvas& canvas, cv::Point2d at)
{
    constexpr std::array paints{base::paint(0xb5472f), base::paint(0x3d8f4d), base::paint(0x2f6fb5)};
    for (std::size_t c = 0; c < channel_names.size(); ++c)
        canvas.text(at + cv::Point2d(178 + 70 * double(c), 0), channel_names[c],
                    {.paint = paints[c], .height = 9, .anchor = base::Anchor::End});
}

/// A layer of the diagram in `area`: its light as arrows on the left, as numbers on the right.
void draw_layer(base::Canvas& canvas, const cv::Rect2d& area, const LayerLight& light, int index)
{
    constexpr std::array tints{base::paint(0xf6e3d6), base::paint(0xf3cfc4), base::paint(0xf7efcf)};
    canvas.rect(area, {tints[std::size_t(index) % tints.size()]});
    const double top = area.y, bottom = area.y + area.height, x = area.x + 24;
    canvas.line({area.x, bottom}, {area.x + area.width, bottom}, {palette::faint, 1});
    draw_arrow(canvas, {x, top - 14}, {x + 22, bottom - 2}, palette::ink);
    draw_arrow(canvas, {x + 8, top + area.height * .35}, {x + 22, top - 10}, backward_paint);
    draw_arrow(canvas, {x + 15, top + area.height * .68}, {x + 38, top - 10}, backward_paint);
    draw_arrow(canvas, {x + 22, bottom - 2}, {x + 58, top - 10}, bottom_paint);
    const cv::Point2d at(area.x + 110, top + 20);
    canvas.text(at,
                fmt::format("{}, {:g} mm, n {:g}, g {:g}", light.name, light.thickness_mm, light.n, light.g),
                {.height = 10});
    draw_numbers(canvas, at + cv::Point2d(0, 22), "light that arrives", light.arriving, palette::faint);
    draw_numbers(canvas, at + cv::Point2d(0, 41), fmt::format("R{}, scattered", index + 1), light.scattered,
                 backward_paint, light.outside);
    draw_numbers(canvas, at + cv::Point2d(0, 60), "Rdr, bottom", light.bottom, bottom_paint, light.outside);
    draw_numbers(canvas, at + cv::Point2d(0, 79), "T", light.transmitted, palette::ink, light.outside);
}

void draw_stack(base::Canvas& canvas, cv::Point2d corner, const std::vector<LayerLight>& layers)
{
    constexpr double width = 440, height = 112;
    draw_channel_names(canvas, corner + cv::Point2d(110, -8));
    for (std::size_t i = 0; i < layers.size(); ++i)
        draw_layer(canvas, {corner.x, corner.y + height * double(i), width, height}, layers[i], int(i));
}

/// Total reflectance of the whole stack, by the paper's sum, by our default and by radiative transfer.
void draw_totals(base::Canvas& canvas, cv::Point2d at, const optics::SkinLayers& tissue)
{
    using optics::ReflectanceModel;
    const std::array<std::pair<const char*, ReflectanceModel>, 3> models{
        {{"R, eqs. (2), (3)", ReflectanceModel::Published},
         {"R, our default", ReflectanceModel::Calibrated},
         {"R, radiative transfer", ReflectanceModel::AddingDoubling}}};
    for (const auto& [name, model] : models) {
        draw_numbers(canvas, at, name, optics::diffuse_color(tissue, model), palette::ink);
        at.y += 20;
    }
}

} // namespace

void draw_layers(Workbench& bench)
{
    const optics::SkinLayers skin = optics::table1();
    optics::SkinLayers dermis = skin;
    dermis.layers = {skin.layers[1]};
    dermis.n_below = 1; // air, so that the bottom reflects
    const std::vector<LayerLight> single = light_through(dermis), several = light_through(skin);
    bench.write_drawing("figure_3", {960, 490}, "Light in one layer and in three", [&](base::Canvas& canvas) {
        canvas.text({20, 26}, "(a) one layer: the dermis of Table 1 in air", {.height = 11});
        draw_stack(canvas, {20, 70}, single);
        draw_totals(canvas, {130, 206}, dermis);
        canvas.text({500, 26}, "(b) three layers: Table 1", {.height = 11});
        draw_stack(canvas, {500, 70}, several);
        draw_totals(canvas, {610, 430}, skin);
        const cv::Point2d legend(20, 290);
        const std::array<std::pair<const char*, base::Paint>, 3> arrows{
            {{"light on its way down; T leaves at the bottom", palette::ink},
             {"R1, R2, R3: scattered back on the way, first part of eq. (3)", backward_paint},
             {"Rdr: reflected at the lower boundary, second part of eq. (3)", bottom_paint}}};
        for (std::size_t i = 0; i < arrows.size(); ++i) {
            const cv::Point2d at = legend + cv::Point2d(0, 20 * double(i));
            draw_arrow(canvas, at + cv::Point2d(0, -4), at + cv::Point2d(26, -4), arrows[i].second);
            canvas.text(at + cv::Point2d(36, 0), arrows[i].first, {.height = 9});
        }
        const std::array notes{"R and T of a layer: shares of the light that arrives there, per channel.",
                               "R of all: what leaves the skin, less what its surface reflects.",
                               "* the layer is thicker than the domain of eqs. (2), (3),",
                               "  0 < d < 1 / (sigma_a + sigma_s' P(g)), in this channel."};
        for (std::size_t i = 0; i < notes.size(); ++i)
            canvas.text(legend + cv::Point2d(0, 76 + 18 * double(i)), notes[i],
                        {.paint = palette::faint, .height = 9});
    });
    std::size_t outside = 0;
    for (const LayerLight& light : several)
        outside += std::size_t(std::ranges::count(light.outside, true));
    bench.say(fmt::format("{} of {} layers and channels are thicker than the equations' domain", outside,
                          several.size() * skin.channels()));
}

} // namespace figure_command
