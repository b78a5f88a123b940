// New epithelium and scar in the picture: their colour against the tissue's optics, and no jump when the
// wound closes.
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"
#include "wound/reflectance_table.hpp"

namespace {

const base::Color wall_color(.55, .36, .27);

/// A wound on a wall, seen head-on with two pixels per texel of the patch. Draws only C of eq. (4), in white
/// ambient light.
struct Wall
{
    Wall() : stage(gpu_test::device(), stage::Stage::prepare(scene()))
    {
        shading.lambert = shading.translucency = shading.ward = shading.normal_map = shading.shadow = false;
        shading.ambient = base::Color::all(1);
    }

    static scene::Scene scene()
    {
        scene::Scene scene = small::scene(
            small::wall(glm::vec3(glm::dvec3(wall_color[0], wall_color[1], wall_color[2]))), 512);
        scene.wounds[0].place = glm::dvec3(0);
        scene.days = {0, 365};
        return scene;
    }

    struct Picture
    {
        cv::Mat3f radiance;
        cv::Mat4f state; // the wound's state map, resampled to the pixels
    };

    Picture draw(double day)
    {
        const double half_width = stage.loaded().wounds[0].prepared().patch.width_mm * .5e-3;
        const head::Camera camera{{0, 0, 1}, {0, 0, 0}, 2 * 180 / CV_PI * std::atan(.5 * half_width)};
        graph::Graph graph;
        const passes::FrameImages images =
            stage
                .declare(graph,
                         {.day = day, .tile = stage.scene().size, .camera = camera, .shading = shading})
                .images;
        graph.readback("picture", images.picture);
        const graph::ReadbackId ids[] = {graph.readback("radiance", images.radiance),
                                         graph.readback("state", images.wounds[0].state)};
        const gpu::FrameResult frame = executor.run(graph);
        cv::Mat4f linear, state;
        frame.mat(ids[0]).convertTo(linear, CV_32F);
        frame.mat(ids[1]).convertTo(state, CV_32F);

        Picture picture;
        cv::cvtColor(linear, picture.radiance, cv::COLOR_RGBA2RGB);
        cv::Mat2f texel(linear.size());
        for (int y = 0; y < texel.rows; ++y)
            for (int x = 0; x < texel.cols; ++x) {
                const glm::vec2 patch = (glm::vec2(x, y) + .5f) / float(texel.cols) - .5f;
                const glm::vec2 uv = patch * images.wounds[0].uv_scale + images.wounds[0].uv_offset;
                texel(y, x) = {uv.x * float(state.cols) - .5f, uv.y * float(state.rows) - .5f};
            }
        cv::remap(state, picture.state, texel, {}, cv::INTER_LINEAR);
        return picture;
    }

    stage::Stage stage;
    optics::Shading shading = optics::skin_shading();
    gpu::Executor executor{gpu_test::device(), gpu_test::shaders()};
};

/// 100 log10(R/G), an erythema index; shading scales all channels alike and does not change it.
double redness(const base::Color& color)
{
    return 100 * std::log10(color[0] / color[1]);
}

/// How much redder the covered tissue is than skin, directly from the optics.
double optical_redness(double injury_mm, double day)
{
    const optics::TissueDay tissue =
        wound::tissue_on(optics::skin(optics::SkinTone::Light), shared::LUT_COVERED, day);
    const auto color = [&](double depth) {
        return optics::tissue_color(optics::layers_at(tissue, depth), optics::ReflectanceModel::Calibrated);
    };
    return redness(color(injury_mm)) - redness(color(0));
}

using NewSkin = gpu_test::Test;

} // namespace

// docs/optics.md quotes what this test prints.
TEST_F(NewSkin, IsAsRedAsItsTissue)
{
    Wall wall;
    const double closed = wound::closure_day(wound::Healing{}.curve);
    double largest = 0, at_closure = 0, last = 1e9;
    for (const double months : {-.5, -.2, 0., 1., 3., 6., 11.}) {
        const double day = closed + 30.44 * months;
        const Wall::Picture seen = wall.draw(day);
        double sum = 0, optics = 0, worst = 0;
        int count = 0;
        for (int y = 0; y < seen.state.rows; y += 5)
            for (int x = 0; x < seen.state.cols; x += 5) {
                const cv::Vec4f& state = seen.state(y, x);
                if (state[3] < .99f || state[2] > 0 || state[1] < .2f)
                    continue;
                const double rendered = redness(seen.radiance(y, x)) - redness(wall_color),
                             expected = optical_redness(state[1], day);
                sum += rendered;
                optics += expected;
                worst = std::max(worst, std::abs(rendered - expected));
                ++count;
            }
        ASSERT_GT(count, 100) << "day " << day;
        EXPECT_LT(std::abs(sum - optics) / count, .3) << "day " << day;
        EXPECT_LT(worst, 1) << "day " << day;
        largest = std::max(largest, std::abs(sum - optics) / count);
        if (months == 0)
            at_closure = sum / count;
        if (months > 0) {
            EXPECT_LT(sum / count, last) << "it fades";
            last = sum / count;
        }
        fmt::print(
            "{:5.1f} months after closure: {:5.2f} redder than skin, by optics {:5.2f}, worst pixel off by "
            "{:.2f}; {:.2f} of the excess at closure, {:.2f} of the blood's\n",
            months, sum / count, optics / count, worst, at_closure > 0 ? sum / count / at_closure : 1,
            wound::scar_after(std::max(months, 0.)).redness / wound::scar_after(0).redness);
    }
    EXPECT_GT(at_closure, 5) << "a new scar is red";
    RecordProperty("largest_mean_difference", fmt::format("{:.3f}", largest));
}

TEST_F(NewSkin, ClosureIsNoJumpInAnyPixel)
{
    Wall wall;
    const double closed = wound::closure_day(wound::Healing{}.curve),
                 last =
                     wound::day_below(wound::Healing{}.curve, wound::smallest_scale * wound::smallest_scale);
    constexpr double step = 1;
    cv::Mat3f before;
    double around = 0; // largest day-to-day change of a pixel in the last days before closure
    for (double day = closed - 4.5; day < last + step; day += step) {
        const cv::Mat3f now = wall.draw(day).radiance;
        const double change = before.empty() ? 0 : cv::norm(before, now, cv::NORM_INF);
        if (day < closed) {
            around = std::max(around, change);
        } else {
            EXPECT_LE(change, around) << "day " << day << ", closed on " << closed;
        }
        before = now;
    }
    EXPECT_GT(around, .005);
}

// Half floats hide a small jump in a pixel, but not in the mean over a zone.
TEST_F(NewSkin, ClosureIsNoJumpInTheMeanOfAnyZone)
{
    constexpr double instant = 1e-3; // days
    Wall wall;
    const double closed = wound::closure_day(wound::Healing{}.curve);
    const std::array days{closed - 1, closed - instant, closed + instant, closed + 1};
    std::array<cv::Mat3f, days.size()> seen;
    for (std::size_t i = 0; i < days.size(); ++i)
        seen[i] = wall.draw(days[i]).radiance;
    std::vector<cv::Mat1f> state; // 2: coverage of the bed, 3: of the area inside the border
    cv::split(wall.draw(closed).state, state);
    const std::array zones{std::pair("rim", cv::Mat1b(state[3] < .01)),
                           std::pair("ring", cv::Mat1b((state[3] > .99) & (state[2] < .01))),
                           std::pair("bed", cv::Mat1b(state[2] > .9))};
    for (const auto& [name, zone] : zones) {
        ASSERT_GT(cv::countNonZero(zone), 100) << name;
        const auto change = [&](std::size_t from, std::size_t to) {
            return cv::norm(cv::mean(seen[to] - seen[from], zone), cv::NORM_INF);
        };
        // The step is 2 instants, 1/500 day: ten times that share of the daily change is allowed.
        EXPECT_LE(change(1, 2), 10 * 2 * instant * std::max(change(0, 1), change(2, 3))) << name;
        EXPECT_GT(std::max(change(0, 1), change(2, 3)), 5e-4) << name << ": the skin must still change";
    }
}
