// Light that spreads in the picture: a wall that faces the camera, lit on one half, against the edge response
// of two independent programs; even light; what is nearer or no skin; the pixels' own light where they are
// wide.
#include "passes/screen_diffusion.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "engine/gpu/texture.hpp"
#include "passes/chang.hpp"
#include "slab_edge.hpp"
#include "tests/support/gpu.hpp"
#include "wound/optics/dipole.hpp"
#include "wound/optics/separable.hpp"

namespace {

constexpr int side = 256;
constexpr double away_m = .5;
const base::Color widths_mm(.485, .264, .159), white(.55, .35, .25);

/// What the camera sees, per pixel.
struct Seen
{
    cv::Mat4f received = cv::Mat4f(side, side, cv::Vec4f(0, 0, 0, 1)),
              reflectance = cv::Mat4f(side, side, cv::Vec4f::all(0)),
              specular = cv::Mat4f(side, side, cv::Vec4f::all(0));
    cv::Mat1f distance = cv::Mat1f(side, side, 0.f);

    void skin(int x, int y, float light, float metres = away_m)
    {
        received(y, x) = {light, light, light, 0};
        reflectance(y, x) = {float(white[0]), float(white[1]), float(white[2]), 0};
        distance(y, x) = metres;
    }
};

optics::TissueSpread slab()
{
    optics::TissueSpread tissue;
    for (int c = 0; c < 3; ++c) {
        tissue.width_mm[c] = widths_mm[c];
        tissue.scattering_length_mm[c] = widths_mm[c] / white[c];
    }
    return tissue;
}

/// The light that is shown, per reflectance. Of `chang` what is gathered nearby.
cv::Mat4f shown(const Seen& seen, optics::Transport transport, double pixels_per_mm)
{
    const auto half = [](const cv::Mat4f& values) {
        cv::Mat result;
        values.convertTo(result, CV_16F);
        return result;
    };
    const gpu::Device& device = gpu_test::device();
    cv::Mat4f wide(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            wide(y, x) = {seen.distance(y, x), 0, 0, 0};
    const gpu::Texture received(device, half(seen.received), gpu::Encoding::Linear, false, "received"),
        reflectance(device, half(seen.reflectance), gpu::Encoding::Linear, false, "reflectance"),
        distance(device, wide, gpu::Encoding::Linear, false, "distance"),
        specular(device, half(seen.specular), gpu::Encoding::Linear, false, "specular");
    const optics::TissueSpread tissue = slab();
    const cv::Mat4f none(1, shared::CHANG_SAMPLES, cv::Vec4f::all(0));
    const gpu::Texture nowhere(device, none, gpu::Encoding::Linear, false, "none");
    graph::Graph graph;
    const passes::ForwardImages drawn{
        .radiance = graph.import("specular", specular),
        .apart = passes::LightApart{.received = graph.import("received", received),
                                    .reflectance = graph.import("reflectance", reflectance),
                                    .distance = graph.import("distance", distance)}};
    const base::Color& length = tissue.scattering_length_mm;
    const passes::ScreenDiffusion diffusion{
        .transport = transport,
        .tile = {.high = glm::vec2(side),
                 .pixels_at_1m = float(1e3 * pixels_per_mm * away_m),
                 .scattering = 1e-3f * glm::vec3(length[0], length[1], length[2])},
        .tissue = tissue,
        .reach = shared::PICTURE_REACH};
    shared::ChangView view{};
    if (transport == optics::Transport::Chang)
        view = passes::chang_view({}, std::array<std::uint32_t, 2>{side, side}, tissue);
    const graph::ImageId empty = graph.import("none", nowhere);
    const graph::ReadbackId back =
        graph.readback("shown", transport == optics::Transport::Chang
                                    ? passes::add_chang(graph, drawn, diffusion, {empty, empty}, view)
                                    : passes::add_screen_diffusion(graph, drawn, diffusion));
    gpu::Executor executor(device, gpu_test::shaders());
    cv::Mat4f result;
    executor.run(graph).mat(back).convertTo(result, CV_32F);
    for (cv::Vec4f& pixel : result)
        for (int c = 0; c < 3; ++c)
            pixel[c] /= float(white[c]);
    return result;
}

/// Lit where x is in the right half; a column's mean is what its pixels show.
Seen half_lit()
{
    Seen seen;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            seen.skin(x, y, x >= side / 2 ? 1 : 0);
    return seen;
}

using ChangInPicture = gpu_test::Test;

class InPicture : public gpu_test::Test, public testing::WithParamInterface<optics::Transport>
{
};
INSTANTIATE_TEST_SUITE_P(Transports, InPicture,
                         testing::Values(optics::Transport::Separable, optics::Transport::Burley),
                         [](const auto& tested) {
                             return optics::transport_names[std::size_t(tested.param)];
                         });

TEST_P(InPicture, BrightensTheDarkAsASlabDoes)
{
    constexpr double pixels_per_mm = 20;
    const cv::Mat4f light = shown(half_lit(), GetParam(), pixels_per_mm);
    // At a tap's place the separable kernel jumps: its taps are up to a width apart.
    const double bar = GetParam() == optics::Transport::Separable ? .045 : .02;
    for (const SlabEdge& edge : slab_edges) {
        const double place = side / 2. - .5 - edge.x_mm * pixels_per_mm;
        const int left = int(std::floor(place));
        for (int c = 0; c < 3; ++c) {
            double left_mean = 0, right_mean = 0;
            for (int y = 0; y < side; ++y) {
                left_mean += light(y, left)[c] / side;
                right_mean += light(y, left + 1)[c] / side;
            }
            EXPECT_NEAR(std::lerp(left_mean, right_mean, place - left), edge.share[std::size_t(c)], bar)
                << edge.x_mm << " mm, channel " << c;
        }
    }
}

// Over all distances the error of the taps' steps is small.
TEST_P(InPicture, KeepsTheMeanOfAnEdge)
{
    constexpr double pixels_per_mm = 20;
    const cv::Mat4f light = shown(half_lit(), GetParam(), pixels_per_mm);
    for (int c = 0; c < 3; ++c) {
        double error = 0, signed_error = 0;
        int count = 0;
        for (int x = side / 2 - 100; x < side / 2; ++x, ++count) {
            double mean = 0;
            for (int y = 0; y < side; ++y)
                mean += light(y, x)[c] / side;
            const double expected = optics::beyond_edge((side / 2 - .5 - x) / pixels_per_mm, widths_mm[c]);
            error += std::abs(mean - expected);
            signed_error += mean - expected;
        }
        EXPECT_LT(error / count, .012) << c;
        EXPECT_LT(std::abs(signed_error / count), .004) << c;
    }
}

TEST_P(InPicture, LeavesEvenLightEvenAlsoAtItsBorders)
{
    Seen seen;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            seen.specular(y, x) = {.25f, .25f, .25f, 1};
            if (x < 200) // beside it is hair
                seen.skin(x, y, .5f);
        }
    const cv::Mat4f light = shown(seen, GetParam(), 5);
    for (int y = 0; y < side; y += 5)
        for (int x = 0; x < side; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(light(y, x)[c], (x < 200 ? .5 : 0) + .25 / white[c], 3e-3) << x << ", " << y;
}

TEST_P(InPicture, DoesNotSpreadToWhatIsBehind)
{
    Seen seen;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            seen.skin(x, y, x >= side / 2 ? 1 : 0, x >= side / 2 ? away_m : away_m + .05);
    const cv::Mat4f light = shown(seen, GetParam(), 10);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            ASSERT_NEAR(light(y, x)[0], x >= side / 2 ? 1 : 0, .07)
                << x << ", " << y; // taps between pixels mix
}

TEST_P(InPicture, LeavesLightWhereItIsWhenAPixelIsWide)
{
    const cv::Mat4f light = shown(half_lit(), GetParam(), .05); // a pixel of 20 mm
    for (int x = 0; x < side; ++x)
        ASSERT_NEAR(light(side / 2, x)[0], x >= side / 2 ? 1 : 0, .03) << x;
}

// Against the dipole itself, whose light within a disc is known: a circle of radius r about a point in the
// dark has the share acos(x/r) / pi in the light.
TEST_F(ChangInPicture, GathersWhatTheDipoleBringsFromNearby)
{
    constexpr double pixels_per_mm = 20;
    const cv::Mat4f light = shown(half_lit(), optics::Transport::Chang, pixels_per_mm);
    const optics::DipoleInversion inversion(1.4);
    for (int c = 0; c < 3; ++c) {
        const optics::Dipole dipole = inversion.dipole_of(white[c], widths_mm[c] / white[c]);
        for (const double x_mm : {.1, .5, 1., 2.}) {
            double expected = 0;
            for (double r = x_mm; r < 30; r += .01)
                expected += (dipole.within(r + .01) - dipole.within(r)) / dipole.total() *
                            std::acos(x_mm / (r + .005)) / CV_PI;
            const double place = side / 2. - .5 - x_mm * pixels_per_mm;
            const int left = int(std::floor(place));
            double left_mean = 0, right_mean = 0;
            for (int y = 0; y < side; ++y) {
                left_mean += light(y, left)[c] / side;
                right_mean += light(y, left + 1)[c] / side;
            }
            // Of the 64 points around a pixel each carries up to .016 of the light, and two can miss the
            // edge.
            EXPECT_NEAR(std::lerp(left_mean, right_mean, place - left), expected, .035)
                << x_mm << " mm, " << c;
        }
    }
}

TEST_F(ChangInPicture, GathersAlmostAllOfEvenLight)
{
    Seen seen;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            seen.skin(x, y, 1);
    const cv::Mat4f light = shown(seen, optics::Transport::Chang, 5);
    EXPECT_NEAR(light(side / 2, side / 2)[0], .99, 3e-3); // the rest is left to the samples
    EXPECT_GE(light(side / 2, side / 2)[2], .989);
    EXPECT_LE(light(side / 2, side / 2)[2], 1.003);
}

} // namespace
