// The compute passes of a wound: the area of the warped mask, the shader's warp against the double-precision
// one, the maps of a day against those of the CPU, extreme days.
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/image_compare.hpp"
#include "passes/wound_texture.hpp"
#include "tests/support/gpu.hpp"
#include "wound/day_maps.hpp"
#include "wound/drawn_region.hpp"
#include "wound/prepare.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace {

using wound::WarpModel;

constexpr WarpModel models[] = {WarpModel::Radial, WarpModel::Grid, WarpModel::Dense, WarpModel::Composed};

/// Skin with a lobed, lopsided red patch, and its mask.
wound::Photograph irregular_photograph()
{
    std::vector<cv::Point> border;
    for (int i = 0; i < 360; ++i) {
        const double angle = i * std::numbers::pi / 180;
        const double radius =
            90 + 28 * std::sin(3 * angle + 1) + 14 * std::sin(7 * angle) + 6 * std::cos(13 * angle);
        border.emplace_back(cvRound(200 + 1.3 * radius * std::cos(angle)),
                            cvRound(190 + radius * std::sin(angle)));
    }
    wound::Photograph photograph{cv::Mat3b(400, 400, cv::Vec3b(205, 160, 138)), cv::Mat1b::zeros(400, 400)};
    cv::fillPoly(photograph.mask, std::vector{border}, 255);
    photograph.srgb.setTo(cv::Vec3b(140, 40, 36), photograph.mask);
    return photograph;
}

wound::PreparedWound prepared(const wound::Photograph& photograph, int patch_size = 512)
{
    wound::Preparation preparation;
    preparation.patch_size = patch_size;
    return wound::prepare(photograph, preparation);
}

/// A day defined by its areas only.
wound::WoundDay day_with(const wound::PreparedWound& wound, double bed_ratio, double border_ratio,
                         WarpModel model = WarpModel::Grid)
{
    wound::WoundDay day;
    day.unhealed_ratio = bed_ratio;
    day.border_ratio = border_ratio;
    day.bed_recovery = day.border_recovery = day.recovery_ratio = std::clamp(1 - bed_ratio, 0.0, 1.0);
    day.depth_scale = std::sqrt(std::min(bed_ratio, 1.0));
    day.border_warp = wound::make_warp(wound.flow, border_ratio, model);
    day.bed_warp = wound::make_warp(wound.flow, bed_ratio, model);
    return day;
}

/// The maps that the passes draw, as floats.
wound::DayMaps draw(gpu::Executor& executor, const passes::WoundMaps& maps, const wound::WoundDay& today)
{
    graph::Graph graph;
    const passes::WoundTexture texture =
        passes::add_wound_texture(graph, "", maps, today, passes::pack_warps(today));
    const graph::ReadbackId ids[] = {graph.readback("color", texture.color),
                                     graph.readback("state", texture.state),
                                     graph.readback("relief", texture.relief)};
    const gpu::FrameResult frame = executor.run(graph);
    wound::DayMaps result{.region = maps.region, .patch_size = maps.size};
    cv::Mat4f* const targets[] = {&result.color, &result.state, &result.relief};
    for (int i = 0; i < 3; ++i)
        frame.mat(ids[i]).convertTo(*targets[i], CV_32F);
    return result;
}

using WoundTextureOnGpu = gpu_test::Test;

void expect_areas(const char* name, const wound::PreparedWound& wound)
{
    const passes::WoundMaps maps = passes::upload_wound(gpu_test::device(), wound.patch);
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const double initial = cv::sum(wound.patch.mask)[0];
    const std::pair<double, double> ratios[] = {{.9, .9},   {.6, .6},    {.4, .4},
                                                {.2, .2},   {.1, .1},    {.05, .05}, // contraction
                                                {.6, .772}, {.05, .4585}};           // a face: .43 + .57 r
    for (const auto& [r, border] : ratios) {
        const cv::Scalar covered = cv::sum(draw(executor, maps, day_with(wound, r, border)).state);
        const double of_bed = covered[2] / initial, of_border = covered[3] / initial;
        EXPECT_NEAR(of_bed / r, 1, .02) << name << ", r = " << r << ", border " << border;
        EXPECT_NEAR(of_bed, r, .005) << name << ", r = " << r << ", border " << border;
        EXPECT_NEAR(of_border / border, 1, .02) << name << ", r = " << r << ", border " << border;
        EXPECT_NEAR(of_border, border, .005) << name << ", r = " << r << ", border " << border;
    }
}

/// Largest distance between the shader's warp and the CPU's, in texels of a patch of 512.
double largest_error(const wound::Warp& warp, gpu::Executor& executor)
{
    constexpr int side = 64;
    std::vector<shared::vec2> values;
    const shared::WarpHeader header = wound::pack(warp, values);
    graph::Graph graph;
    const graph::ImageId day0 = graph.image("day0", {side, side, VK_FORMAT_R32G32B32A32_SFLOAT});
    graph::ComputePass& pass = graph.compute("warp test", "warp_test.comp");
    pass.constant("WARP_MODEL", std::uint32_t(warp.model));
    pass.uniform("Header", header);
    pass.buffer<shared::vec2>("WarpValues_", values);
    pass.store("day0", day0);
    pass.dispatch(side, side);
    const graph::ReadbackId back = graph.readback("day0", day0);
    const gpu::FrameResult frame = executor.run(graph);
    const cv::Mat4f shader = frame.mat(back);
    const cv::Mat2d reference = wound::backward_map(warp, side);
    double largest = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double error =
                std::hypot(shader(y, x)[0] - reference(y, x)[0], shader(y, x)[1] - reference(y, x)[1]);
            largest = std::isfinite(error) ? std::max(largest, error) : INFINITY;
        }
    return largest * 256;
}

/// `largest`: the bound for each channel's difference.
void expect_near(const cv::Mat4f& map, const cv::Mat4f& reference, const cv::Vec4d& largest,
                 const std::string& where)
{
    constexpr double mean = 5e-4; // rounding alone stays below it; a larger mean is a systematic error
    ASSERT_EQ(map.size(), reference.size());
    const cv::Mat4f off = cv::abs(map - reference);
    const cv::Scalar means = cv::mean(off);
    for (int c = 0; c < 4; ++c) {
        cv::Mat1f channel;
        cv::extractChannel(off, channel, c);
        EXPECT_LT(cv::norm(channel, cv::NORM_INF), largest[c]) << where << ", channel " << c;
        EXPECT_LT(means[c], mean) << where << ", channel " << c;
    }
}

} // namespace

TEST_F(WoundTextureOnGpu, WarpedMaskHasTheRequestedArea)
{
    expect_areas("default", prepared(wound::synthesize({})));
    expect_areas("irregular", prepared(irregular_photograph()));
}

// Single precision against double. Largest errors found on lavapipe, in texels of 512: radial .0001, grid
// .0001, dense .1 (one thin-plate spline for the whole warp has huge weights that cancel), composed .001. The
// bounds leave room for a device with less accurate logarithms.
TEST_F(WoundTextureOnGpu, EveryModelOfTheWarpEqualsTheReference)
{
    const std::map<WarpModel, double> bounds{{WarpModel::Radial, .001},
                                             {WarpModel::Grid, .001},
                                             {WarpModel::Dense, .5},
                                             {WarpModel::Composed, .01}};
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    for (const wound::Photograph& photograph : {wound::synthesize({}), irregular_photograph()}) {
        const wound::PreparedWound wound = prepared(photograph, 256);
        for (const WarpModel model : models) {
            double largest = 0;
            for (const double r : {1.4, 1., .5, .05, 0.}) {
                const double error = largest_error(wound::make_warp(wound.flow, r, model), executor);
                EXPECT_LT(error, bounds.at(model)) << "model " << int(model) << ", r = " << r;
                largest = std::max(largest, error);
            }
            RecordProperty(fmt::format("largest_error_in_texels_model_{}", int(model)),
                           std::to_string(largest));
        }
    }
}

TEST_F(WoundTextureOnGpu, EveryDayGivesValidColorsAndShares)
{
    const wound::PreparedWound wound = prepared(wound::synthesize({}), 128);
    const passes::WoundMaps maps = passes::upload_wound(gpu_test::device(), wound.patch);
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    std::vector<std::pair<std::string, wound::WoundDay>> days;
    for (const WarpModel model : models)
        for (const double r : {0.0, .01, 1.4})
            days.emplace_back(fmt::format("r = {}, model {}", r, int(model)),
                              day_with(wound, r, .43 + .57 * r, model));
    for (const double day : {0.0, 1e-3, 30.0, 1e9})
        for (const wound::HealingModel model : {wound::HealingModel::Contraction, wound::HealingModel::Face})
            for (const auto& [delta, theta] :
                 {std::pair(0.0, 0.0), {.02822, 0.0}, {.02822, -1.0}, {10.0, 1.0}}) {
                wound::Healing healing;
                healing.curve.delta = delta;
                healing.curve.theta = theta;
                healing.model = model;
                days.emplace_back(
                    fmt::format("day {}, model {}, delta {}, theta {}", day, int(model), delta, theta),
                    wound::wound_at(wound, healing, day));
            }
    for (const auto& [name, today] : days) {
        const wound::DayMaps drawn = draw(executor, maps, today);
        for (const cv::Mat4f& map : {drawn.color, drawn.state, drawn.relief})
            ASSERT_FALSE(base::first_non_finite(map)) << name;
        std::vector<cv::Mat1f> color, state;
        cv::split(drawn.color, color);
        cv::split(drawn.state, state);
        for (const cv::Mat1f& channel : color)
            ASSERT_TRUE(cv::checkRange(channel, true, nullptr, 0, 1.001))
                << name << ": a colour or the opacity leaves 0..1";
        for (int share : {2, 3})
            ASSERT_TRUE(cv::checkRange(state[share], true, nullptr, 0, 1.001))
                << name << ": a share leaves 0..1, channel " << share;
    }
}

// Outside the drawn region the opacity is zero on every day; inside it the maps equal those of the whole
// patch.
TEST_F(WoundTextureOnGpu, OnlyTheWoundsOwnRegionIsDrawn)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    wound::Healing face, contraction, growing;
    contraction.model = wound::HealingModel::Contraction;
    growing.model = wound::HealingModel::Contraction;
    growing.curve.theta = -.4; // grows to 1.4 of its area, then heals
    for (const wound::Photograph& photograph : {wound::synthesize({}), irregular_photograph()}) {
        wound::PreparedWound wound = prepared(photograph, 128);
        wound.patch.opacity.setTo(0, wound.patch.opacity < .05f); // its edge is then visible
        passes::WoundMaps maps = passes::upload_wound(gpu_test::device(), wound.patch);
        for (const wound::Healing& healing : {face, contraction, growing}) {
            const cv::Rect whole = maps.region, region = wound::drawn_region(wound, healing);
            EXPECT_LT(region.area(), .9 * whole.area());
            for (const double day : {0., .5, 1., 3., 8., 20., 27., 60., 400.}) {
                const wound::WoundDay today = wound::wound_at(wound, healing, day);
                const wound::DayMaps all = draw(executor, maps, today);
                maps.region = region;
                const wound::DayMaps part = draw(executor, maps, today);
                maps.region = whole;
                cv::Mat1f opacity;
                cv::extractChannel(all.color, opacity, 3);
                EXPECT_EQ(cv::norm(part.color, all.color(region), cv::NORM_INF), 0) << "day " << day;
                EXPECT_EQ(cv::norm(part.state, all.state(region), cv::NORM_INF), 0) << "day " << day;
                opacity(region).setTo(0);
                EXPECT_EQ(cv::countNonZero(opacity), 0) << "day " << day << ", region " << region;
            }
        }
    }
}

TEST_F(WoundTextureOnGpu, DayZeroIsThePatchItself)
{
    const wound::PreparedWound wound = prepared(wound::synthesize({}));
    const passes::WoundMaps maps = passes::upload_wound(gpu_test::device(), wound.patch);
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    for (const wound::HealingModel model : {wound::HealingModel::Contraction, wound::HealingModel::Face}) {
        wound::Healing healing;
        healing.model = model;
        const wound::DayMaps drawn = draw(executor, maps, wound::wound_at(wound, healing, 0));
        cv::Mat3f color;
        cv::Mat1f bed;
        cv::cvtColor(drawn.color, color, cv::COLOR_RGBA2RGB);
        cv::extractChannel(drawn.state, bed, 2);
        EXPECT_LT(cv::norm(color, wound.patch.color, cv::NORM_INF),
                  .002); // two half floats and an identity warp
        EXPECT_LT(cv::norm(bed, wound.patch.mask, cv::NORM_INF), .002);
    }
}

// Day 0 and today are stored in half floats, each within half a step, 2^-11 of the value. A device may filter
// with weights in steps of 1/256, which adds as much again in a texture with texels that differ by up to a
// half. Slope and occlusion are differences of such depths over one texel or more.
TEST_F(WoundTextureOnGpu, MapsOfADayEqualThoseOfTheCpu)
{
    constexpr double share = 2e-3; // of the largest value
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    for (const std::string& kind : wound::kind_names()) {
        const wound::PreparedWound wound = prepared(wound::synthesize({.kind = kind, .seed = 3}), 256);
        passes::WoundMaps maps = passes::upload_wound(gpu_test::device(), wound.patch);
        const double depth = share * cv::norm(wound.patch.depth_mm, cv::NORM_INF),
                     slope = .5 * depth / (maps.width_mm / maps.size);
        for (const auto model : {wound::HealingModel::Face, wound::HealingModel::Contraction}) {
            wound::Healing healing;
            healing.model = model;
            maps.region = wound::drawn_region(wound, healing);
            for (const double day : {0., 3., 8., 12., 20., 60.}) {
                const wound::WoundDay today = wound::wound_at(wound, healing, day);
                const wound::DayMaps cpu = wound::maps_on(wound, today, maps.region);
                const wound::DayMaps drawn = draw(executor, maps, today);
                const std::string where = fmt::format("{}, model {}, day {}: ", kind, int(model), day);
                expect_near(drawn.color, cpu.color, cv::Vec4d::all(share), where + "color");
                expect_near(drawn.state, cpu.state, {depth, depth, share, share}, where + "state");
                expect_near(drawn.relief, cpu.relief, {slope, slope, slope, depth}, where + "relief");
            }
        }
    }
}
