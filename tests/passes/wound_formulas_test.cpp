// The formulas of wound_texture.comp and wound_relief.comp, except the warp, against independent
// double-precision versions.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "base/sampling.hpp"
#include "passes/wound_texture.hpp"
#include "tests/support/gpu.hpp"
#include "wound/healing/phases.hpp"
#include "wound/prepare.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace {

using WoundFormulas = gpu_test::Test;

cv::Mat4f read(const gpu::FrameResult& frame, graph::ReadbackId id)
{
    cv::Mat4f values;
    frame.mat(id).convertTo(values, CV_32F);
    return values;
}

// The maps hold half floats (11 bits); such an error in a rank changes a texel by three times as much.
TEST_F(WoundFormulas, PhaseColoursOfTheBedEqualTheReference)
{
    constexpr int side = 64;
    wound::Patch patch{cv::Mat3f(side, side), cv::Mat1f(side, side, 1.f), cv::Mat1f(side, side, 1.f),
                       cv::Mat1f(side, side, 0.f), 30};
    cv::RNG random(7);
    random.fill(patch.color, cv::RNG::UNIFORM, 0, 1);
    patch.color(0, 0) = {0, 0, 0}; // the extremes
    patch.color(0, 1) = {1, 1, 1};
    patch.color(0, 2) = {1, 0, 0};
    patch.color(0, 3) = {0, 1, 0};
    const double luminance = wound::bed_luminance(patch);
    const std::vector<cv::Mat> levels = base::mip_levels(patch.color);
    const passes::WoundMaps maps = passes::upload_wound(gpu_test::device(), patch);
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());

    std::vector<wound::Phase> phases{{1, 1, 1, 1}, {0, 0, 0, 0}, {.3, 0, .9, .5}};
    for (const double day : {0., .7, 2., 4., 7., 12., 30.})
        phases.push_back(wound::phase_at(day, 30));
    for (const wound::Phase& phase : phases) {
        wound::WoundDay day;
        day.in_phases = true;
        day.phase = phase;
        graph::Graph graph;
        const graph::ReadbackId id = graph.readback(
            "color", passes::add_wound_texture(graph, "", maps, day, passes::pack_warps(day)).color);
        const cv::Mat4f drawn = read(executor.run(graph), id);
        double worst = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const cv::Vec3d expected = wound::tinted(
                    patch.color(y, x), base::sample<3>(levels, {(x + .5) / side, (y + .5) / side}, 2.5),
                    phase, luminance);
                for (int c = 0; c < 3; ++c) {
                    ASSERT_TRUE(std::isfinite(drawn(y, x)[c]) && drawn(y, x)[c] >= 0);
                    worst = std::max(worst, std::abs(drawn(y, x)[c] - expected[c]));
                }
            }
        EXPECT_LT(worst, .003) << "clot " << phase.clot << ", fibrin " << phase.fibrin << ", granulation "
                               << phase.granulation;
    }
}

/// Depth today, mm, from the state map, clamped to the edge.
double depth(const cv::Mat4f& state, int x, int y, double scale, double scar_mm)
{
    const cv::Vec4f s = state(std::clamp(y, 0, state.rows - 1), std::clamp(x, 0, state.cols - 1));
    return scale * s[0] - scar_mm * std::max(double(s[3]) - s[2], 0.);
}

/// Slope of the bed's bumps as of a depth: .25 mm for e times the luminance, between the corners of a square
/// of about .5 mm.
cv::Vec2d bump_slope(const cv::Mat4f& color, int x, int y, double texel_mm)
{
    const double half_side = std::floor(.25 / texel_mm) + .5;
    const auto height = [&](double dx, double dy) { // of the mean of the four texels at a corner
        double sum = 0;
        for (const double i : {-.5, .5})
            for (const double j : {-.5, .5}) {
                const cv::Vec4f c = color(std::clamp(int(std::lround(y + dy + j)), 0, color.rows - 1),
                                          std::clamp(int(std::lround(x + dx + i)), 0, color.cols - 1));
                sum += (.2126 * c[0] + .7152 * c[1] + .0722 * c[2]) / 4;
            }
        return .25 * std::log(std::max(sum, 1e-3));
    };
    const double h = half_side, left = height(-h, -h) + height(-h, h), right = height(h, -h) + height(h, h),
                 top = height(-h, -h) + height(h, -h), bottom = height(-h, h) + height(h, h);
    return cv::Vec2d(left - right, top - bottom) / (4 * h * texel_mm);
}

TEST_F(WoundFormulas, ReliefIsTheSlopeAndTheOpennessOfTheDepth)
{
    wound::Preparation preparation;
    preparation.patch_size = 128;
    const wound::PreparedWound wound = wound::prepare(wound::synthesize({}), preparation);
    const passes::WoundMaps maps = passes::upload_wound(gpu_test::device(), wound.patch);
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const double texel_mm = wound.patch.width_mm / 128, reach = 4 / texel_mm;
    double steepest_bump = 0;

    for (const double today : {0., 6., 15., 60.}) {
        const wound::WoundDay day = wound::wound_at(wound, {}, today);
        graph::Graph graph;
        const passes::WoundTexture texture =
            passes::add_wound_texture(graph, "", maps, day, passes::pack_warps(day));
        const graph::ReadbackId color_id = graph.readback("color", texture.color),
                                state_id = graph.readback("state", texture.state),
                                relief_id = graph.readback("relief", texture.relief);
        const gpu::FrameResult frame = executor.run(graph);
        const cv::Mat4f color = read(frame, color_id), state = read(frame, state_id),
                        relief = read(frame, relief_id);
        const double left =
            std::min(4 * day.unhealed_ratio, 1.); // granulation fills the last quarter of the area
        const double scale = day.depth_scale * left * left * (3 - 2 * left);
        const auto at = [&](int x, int y) { return depth(state, x, y, scale, day.scar.height_mm); };
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x) {
                double du = 0, dv = 0;
                for (int k = -1; k <= 1; ++k) {
                    const double weight = (2 - std::abs(k)) / (8 * texel_mm);
                    du += weight * (at(x + 1, y + k) - at(x - 1, y + k));
                    dv += weight * (at(x + k, y + 1) - at(x + k, y - 1));
                }
                double open = 0;
                for (int direction = 0; direction < 6; ++direction) {
                    const double angle = 2 * std::numbers::pi * (direction + .5) / 6;
                    double horizon = 0; // elevation
                    for (const double share : {1 / 16., 4 / 16., 9 / 16., 1.}) {
                        const int i = x + int(std::lround(std::cos(angle) * share * reach)),
                                  j = y + int(std::lround(std::sin(angle) * share * reach));
                        horizon = std::max(
                            horizon, std::atan2(at(x, y) - at(i, j), std::max(share * reach, 1.) * texel_mm));
                    }
                    open += std::pow(std::cos(horizon), 2) / 6;
                }
                const cv::Vec2d bumps = bump_slope(color, x, y, texel_mm);
                du += state(y, x)[2] * bumps[0];
                dv += state(y, x)[2] * bumps[1];
                steepest_bump = std::max(steepest_bump, cv::norm(bumps));
                const double gentler = 1 / (1 + .7 * std::hypot(du, dv));
                du *= gentler;
                dv *= gentler;
                ASSERT_NEAR(relief(y, x)[0], du, .002 + .002 * std::abs(du))
                    << "day " << today << " at " << x << ", " << y;
                ASSERT_NEAR(relief(y, x)[1], dv, .002 + .002 * std::abs(dv))
                    << "day " << today << " at " << x << ", " << y;
                ASSERT_NEAR(relief(y, x)[2], open, .002) << "day " << today << " at " << x << ", " << y;
                ASSERT_NEAR(relief(y, x)[3], at(x, y), .003) << "day " << today << " at " << x << ", " << y;
            }
    }
    EXPECT_GT(steepest_bump, .1);
}

} // namespace
