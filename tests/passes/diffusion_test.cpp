// The spread of light on the skin's atlas: a plane that is lit on one half, against the edge response of two
// independent programs.
#include <array>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "engine/gpu/texture.hpp"
#include "head/vectors.hpp"
#include "passes/diffusion.hpp"
#include "shaders/shared/skin.h"
#include "slab_edge.hpp"
#include "tests/support/gpu.hpp"
#include "wound/optics/transport.hpp"

namespace {

constexpr int side = 128;

cv::Mat half(const cv::Mat4f& values)
{
    cv::Mat result;
    values.convertTo(result, CV_16F);
    return result;
}

/// A plane on the atlas: texel (x, y) lies at skew * (x, y) mm.
struct Plane
{
    cv::Matx22d skew; // by rows
    /// Where light falls.
    bool lit(int x, int y) const { return position(x, y)[0] > position(side / 2, side / 2)[0] - 1e-6; }
    cv::Vec2d position(double x, double y) const { return skew * cv::Vec2d(x - side / 2., y - side / 2.); }
};

/// Brightness of the texels, as they are shown.
cv::Mat4f spread(const Plane& plane, const cv::Vec3d& width_mm)
{
    cv::Mat4f place(side, side), light(side, side), ones(4, 4, cv::Vec4f::all(1));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const cv::Vec2d at = plane.position(x, y);
            place(y, x) = {float(at[0]), float(at[1]), 0, 1};
            light(y, x) = cv::Vec4f::all(plane.lit(x, y) ? 1 : 0);
        }
    const cv::Vec2d u(plane.skew(0, 0), plane.skew(1, 0)), v(plane.skew(0, 1), plane.skew(1, 1));
    const double along = cv::norm(u), lean = u.dot(v) / along, across = std::sqrt(v.dot(v) - lean * lean);
    const double radius = std::sqrt(along * across / CV_PI);
    const cv::Mat4f metrics(side, side, cv::Vec4f(float(along), float(lean), float(across), float(radius)));

    const gpu::Device& device = gpu_test::device();
    const auto texture = [&](const cv::Mat& values, const char* name) {
        return gpu::Texture(device, values, gpu::Encoding::Linear, false, name);
    };
    const gpu::Texture places = texture(place, "places"), metric_map = texture(metrics, "metrics"),
                       lights = texture(half(light), "light"), albedo = texture(half(ones), "albedo");
    graph::Graph graph;
    const graph::ImageId diffused = graph.image("diffused", {side, side, VK_FORMAT_R16G16B16A16_SFLOAT});
    graph::ComputePass& pass = graph.compute("spread", "skin_diffused.comp");
    pass.sample("places", graph.import("places", places), graph::Sampler::NearestClamp);
    pass.sample("metrics", graph.import("metrics", metric_map), graph::Sampler::NearestClamp);
    pass.sample("gathered", graph.import("light", lights), graph::Sampler::NearestClamp);
    pass.sample("skin_albedo", graph.import("albedo", albedo));
    pass.store("diffused", diffused);
    pass.uniform("Diffusion_", passes::diffusion_params(width_mm));
    pass.dispatch(side, side);
    const graph::ReadbackId back = graph.readback("diffused", diffused);
    gpu::Executor executor(device, gpu_test::shaders());
    cv::Mat4f result;
    executor.run(graph).mat(back).convertTo(result, CV_32F);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (int c = 0; c < 3; ++c) {
                const double near = optics::left_within(result(y, x)[3], width_mm[c]);
                result(y, x)[c] = float(near * light(y, x)[c] + (1 - near) * result(y, x)[c]);
            }
    return result;
}

using Diffusion = gpu_test::Test;

const cv::Vec3d widths_mm(.485, .264, .159); // of Burley's profile for that slab

void expect_edge(const Plane& plane)
{
    const cv::Mat4f shown = spread(plane, widths_mm);
    // Texels of a row near the middle, by their distance from the edge of the light.
    std::vector<std::pair<double, cv::Vec4f>> dark;
    const double border =
        plane.position(side / 2, side / 2)[0] - .5 * std::abs(plane.skew(0, 0)); // between two texels
    for (int x = 0; x < side; ++x) {
        const double distance = border - plane.position(x, side / 2)[0];
        if (distance > 0)
            dark.emplace_back(distance, shown(side / 2, x));
    }
    std::ranges::sort(dark, {}, &std::pair<double, cv::Vec4f>::first);
    for (const SlabEdge& edge : slab_edges)
        for (int c = 0; c < 3; ++c) {
            const auto beyond =
                std::ranges::lower_bound(dark, edge.x_mm, {}, &std::pair<double, cv::Vec4f>::first);
            ASSERT_NE(beyond, dark.end());
            const auto before = beyond == dark.begin() ? beyond : std::prev(beyond);
            const double gap = beyond->first - before->first,
                         share = gap > 0 ? (edge.x_mm - before->first) / gap : 0;
            const double value = std::lerp(double(before->second[c]), double(beyond->second[c]), share);
            EXPECT_NEAR(value, edge.share[std::size_t(c)], .02) << edge.x_mm << " mm, channel " << c;
        }
}

TEST_F(Diffusion, BrightensTheDarkAsASlabDoes)
{
    expect_edge({{.2, 0, 0, .2}});
}

TEST_F(Diffusion, IsTheSameOnSkewedAndMirroredCharts)
{
    expect_edge({{-.2, 0, 0, .25}});
    expect_edge({{.2, .2, 0, .2}}); // columns lean
}

TEST_F(Diffusion, LeavesEvenLightEvenAndSkinWithoutSurroundingsAlone)
{
    const cv::Mat4f shown = spread({{.2, 0, 0, .2}}, widths_mm);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(shown(side / 2, side - 2)[c], 1, 2e-3); // at the atlas' border too
    const cv::Mat4f none = spread({{.2, 0, 0, .2}}, {0, 0, 0});
    for (int x = 0; x < side; ++x)
        EXPECT_EQ(none(side / 2, x)[0], x >= side / 2 ? 1 : 0);
}

TEST(DiffusionTaps, CutTheProfileIntoEqualShares)
{
    const auto taps = optics::diffusion_taps();
    for (std::size_t k = 0; k < taps.size(); ++k)
        EXPECT_NEAR(optics::left_within(std::hypot(taps[k][0], taps[k][1]), 1),
                    (double(k) + .5) / double(taps.size()), 1e-9);
}

} // namespace
