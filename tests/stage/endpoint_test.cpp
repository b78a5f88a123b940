// The two ends of healing: day 0 shows the wound's own picture, closure shows the skin as it was before the
// wound.
#include <cmath>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "scene/command_line.hpp"
#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"

namespace {

/// Draws only C of eq. (4), in white ambient light.
optics::Shading bare_color(optics::Shading shading)
{
    shading.lambert = shading.translucency = shading.ward = shading.normal_map = shading.shadow = false;
    shading.rho_d = 1;
    shading.ambient = base::Color::all(1);
    return shading;
}

/// The linear radiance of a day, as floats.
cv::Mat3f radiance(const stage::Stage& stage, double day, const head::Camera& camera,
                   const optics::Shading& shading)
{
    graph::Graph graph;
    graph.readback(
        "picture",
        stage.declare(graph, {.day = day, .tile = stage.scene().size, .camera = camera, .shading = shading})
            .images.picture);
    const auto found = std::ranges::find(graph.images, "radiance", &graph::Graph::Image::name);
    const graph::ReadbackId back = graph.readback("radiance", {std::uint32_t(found - graph.images.begin())});
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    cv::Mat4f linear;
    executor.run(graph).mat(back).convertTo(linear, CV_32F);
    cv::Mat3f rgb;
    cv::cvtColor(linear, rgb, cv::COLOR_RGBA2RGB);
    return rgb;
}

cv::Mat4b picture(const stage::Stage& stage, double day)
{
    graph::Graph graph;
    const graph::ReadbackId back = graph.readback(
        "picture", stage.declare(graph, {.day = day, .tile = stage.scene().size}).images.picture);
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    return executor.run(graph).mat(back).clone();
}

/// Waits until the scene's first wound is fitted, and returns it.
const scene::FittedWound& fitted_wound(const stage::Stage::Preparation& preparation)
{
    const scene::Wound& wound = preparation.scene.wounds[0];
    std::shared_ptr<const scene::FittedPhotograph> photograph;
    while (!(photograph = preparation.loader->fitted({wound, name_of(wound, 0)}, preparation.head))) {
        preparation.loader->wait();
        preparation.loader->collect();
    }
    return photograph->wounds[0]; // owned by the loader
}

using Endpoint = gpu_test::Test;

} // namespace

// A flat wall of one colour, seen head-on with two pixels per texel of the patch: the picture must be the
// patch over the wall's colour, within the precision of half floats.
TEST_F(Endpoint, DayZeroShowsTheWoundsOwnPicture)
{
    const glm::vec3 skin(0.55f, 0.36f, 0.27f);
    for (const bool published : {false, true}) {
        scene::Scene scene = small::scene(small::wall(skin), 512);
        scene.wounds[0].place = glm::dvec3(0);
        if (published)
            scene::make_published(scene);
        const stage::Stage::Preparation props = stage::Stage::prepare(scene);
        const scene::FittedWound& fitted = fitted_wound(props);
        const wound::Patch patch = fitted.prepared.patch;
        cv::Mat(patch.depth_mm).setTo(0); // shares its pixels with the stage; a cavity would occlude itself
        const double half_width = fitted.anchor.half_width_m;
        const stage::Stage stage(gpu_test::device(), props);
        const double fov_deg =
            2 * 180 / CV_PI * std::atan(0.5 * half_width / 1.0); // the middle half of the patch, from 1 m
        const cv::Mat3f seen = radiance(stage, 0, {{0, 0, 1}, {0, 0, 0}, fov_deg}, bare_color(scene.shading));

        cv::Mat2f texel(seen.size());
        for (int y = 0; y < seen.rows; ++y)
            for (int x = 0; x < seen.cols; ++x)
                texel(y, x) = {(float(x) + 0.5f) / 2 + 127.5f, (float(y) + 0.5f) / 2 + 127.5f};
        cv::Mat3f color;
        cv::Mat1f opacity;
        cv::remap(patch.color, color, texel, {}, cv::INTER_LINEAR);
        cv::remap(patch.opacity, opacity, texel, {}, cv::INTER_LINEAR);
        double largest = 0, opaque = 0;
        cv::Point at;
        for (int y = 0; y < seen.rows; ++y)
            for (int x = 0; x < seen.cols; ++x) {
                const cv::Vec3f expected =
                    opacity(y, x) * color(y, x) + (1 - opacity(y, x)) * cv::Vec3f(skin.x, skin.y, skin.z);
                if (const double difference = cv::norm(seen(y, x) - expected, cv::NORM_INF);
                    difference > largest) {
                    largest = difference;
                    at = {x, y};
                }
                opaque += opacity(y, x) > 0.999;
            }
        EXPECT_GT(opaque / double(seen.total()), 0.3);
        EXPECT_LT(largest, 0.004) << (published ? "published" : "corrected") << " mode, at " << at;
    }
}

TEST_F(Endpoint, ClosureRestoresTheSkinBeforeTheWound)
{
    scene::Scene scene = small::scene(small::head());
    scene.wounds[0].healing.model = wound::HealingModel::Contraction;
    for (const auto transport : {optics::Transport::Preintegrated, optics::Transport::Diffused}) {
        scene.shading.transport = transport;
        scene::Scene unhurt = scene;
        unhurt.wounds.clear();
        const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
        const stage::Stage bare(gpu_test::device(), stage::Stage::prepare(unhurt));
        const cv::Mat4b without = picture(bare, 365);
        // Around the wound light spreads on finer texels than elsewhere.
        EXPECT_LE(cv::norm(picture(stage, 365), without, cv::NORM_INF),
                  transport == optics::Transport::Diffused ? 3 : 1);
        EXPECT_GT(cv::norm(picture(stage, 0), without, cv::NORM_INF), 40)
            << "the wound must be visible on day 0";
    }
}

// No pixel may jump by more than its day-to-day change around closure. A jump is the part of a change that
// remains when the step shrinks. Half-day steps must not suddenly grow either.
TEST_F(Endpoint, NothingJumpsWhereTheWoundBecomesAScar)
{
    for (const auto model : {wound::HealingModel::Face, wound::HealingModel::Contraction}) {
        scene::Scene scene = small::scene(small::head(), 128);
        scene.wounds[0].healing.model = model;
        const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
        const double closed = wound::closure_day(scene.wounds[0].healing.curve);
        const auto seen = [&](double day) {
            return radiance(stage, day, stage.loaded().close_up(0), scene.shading);
        };
        const std::string name = model == wound::HealingModel::Face ? "face" : "contraction";

        std::vector<cv::Mat3f> steps; // half days
        for (int k = -6; k <= 6; ++k)
            steps.push_back(seen(closed + 0.5 * k));
        std::vector<double> change;
        for (std::size_t k = 0; k + 1 < steps.size(); ++k)
            change.push_back(cv::norm(steps[k + 1], steps[k], cv::NORM_INF));
        cv::Mat3f jump, before, after;
        cv::absdiff(seen(closed + 0.005), seen(closed - 0.005), jump);
        cv::absdiff(steps[6], steps[4], before);
        cv::absdiff(steps[8], steps[6], after);
        const cv::Mat3f around = cv::max(before, after); // per day, pixel by pixel
        constexpr double half_float = 1e-3;              // radiance is held in half floats
        double least = 1;
        cv::minMaxLoc(cv::Mat3f(around - jump).reshape(1), &least);
        EXPECT_GE(least, -half_float) << name;
        EXPECT_LE(cv::norm(jump, cv::NORM_INF), 0.1 * std::max(change[5], change[6]) + half_float) << name;
        for (std::size_t k = 1; k + 1 < change.size(); ++k)
            EXPECT_LE(change[k], 2 * std::max(change[k - 1], change[k + 1]) + half_float)
                << name << ", from day " << closed + 0.5 * (double(k) - 6);
        EXPECT_GT(change[0], 4 * half_float) << name << ": the skin must still change";
    }
}
