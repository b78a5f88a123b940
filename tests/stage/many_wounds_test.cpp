// Scenes of many wounds: all are drawn and labelled, of those that meet in one place the nearest.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/input_error.hpp"
#include "passes/labels.hpp"
#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr int side = 8; // wounds along each side of the wall
constexpr double apart_m = .02;

/// The wall of small::wall() in cells of 4 mm, so that a triangle meets few wounds.
head::Model fine_wall()
{
    constexpr std::uint32_t cells = 60;
    head::Model model = small::wall({.55f, .36f, .27f});
    const head::Vertex corner = model.vertices.front();
    model.vertices.clear();
    model.indices.clear();
    for (std::uint32_t y = 0; y <= cells; ++y)
        for (std::uint32_t x = 0; x <= cells; ++x) {
            head::Vertex vertex = corner;
            vertex.uv = glm::vec2(x, y) / float(cells);
            vertex.position = {.24f * (vertex.uv.x - .5f), .24f * (.5f - vertex.uv.y), 0};
            model.vertices.push_back(vertex);
        }
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t a = y * (cells + 1) + x, b = a + cells + 1;
            model.indices.insert(model.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    model.primitives.front().first_index = 0;
    model.primitives.front().index_count = std::uint32_t(model.indices.size());
    head::update_bounds(model);
    return model;
}

glm::dvec3 place_of(int wound)
{
    return {apart_m * (wound % side - .5 * (side - 1)), apart_m * (.5 * (side - 1) - wound / side), 0};
}

scene::Wound wound_at(const glm::dvec3& place, double width_mm)
{
    scene::Wound wound;
    wound.kind = "abrasion";
    wound.place = place;
    wound.width_mm = width_mm;
    return wound;
}

/// 64 wounds of 6 mm, each 2 cm from the next.
scene::Scene scene_of_many()
{
    scene::Scene scene = small::scene(fine_wall(), 400);
    scene.wounds.clear();
    for (int i = 0; i < side * side; ++i)
        scene.wounds.push_back(wound_at(place_of(i), 6));
    return scene;
}

/// Nine wounds whose middles are 1 mm apart.
scene::Scene scene_of_nine()
{
    scene::Scene scene = small::scene(fine_wall(), 200);
    scene.wounds.clear();
    for (int i = 0; i < 9; ++i)
        scene.wounds.push_back(wound_at({.001 * i, 0, 0}, 20));
    return scene;
}

/// In front of the wall's middle; the view is 18 cm across.
const head::Camera camera{{0, 0, .6}, {0, 0, 0}, 17.06};

struct Labelled
{
    cv::Mat4b picture;
    std::vector<passes::VisibleWound> visible;
    std::vector<passes::WoundSize> sizes;
    cv::Mat2b kinds;
};

Labelled labelled(const stage::Stage& stage, double day)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    const passes::FrameImages images =
        stage.declare(graph, {.day = day, .tile = stage.scene().size, .camera = camera}).images;
    const auto picture = graph.readback("picture", images.picture),
               kinds = graph.readback("kinds", images.labels.kinds),
               measures = graph.readback("measures", images.labels.measures);
    std::vector<std::array<graph::ReadbackId, 2>> maps;
    for (const passes::WoundTexture& wound : images.wounds)
        maps.push_back({graph.readback(fmt::format("state {}", maps.size()), wound.state),
                        graph.readback(fmt::format("relief {}", maps.size()), wound.relief)});
    const gpu::FrameResult frame = executor.run(graph);
    Labelled result{frame.mat(picture).clone(), {}, {}, frame.mat(kinds).clone()};
    result.visible = passes::visible_wounds(result.kinds, frame.mat(measures), maps.size());
    for (std::size_t i = 0; i < maps.size(); ++i) {
        cv::Mat4f state, relief;
        frame.mat(maps[i][0]).convertTo(state, CV_32F);
        frame.mat(maps[i][1]).convertTo(relief, CV_32F);
        result.sizes.push_back(passes::wound_size(stage.loaded().surface_mm2(i), state, relief));
    }
    return result;
}

cv::Mat4b drawn(const stage::Stage& stage, std::optional<double> light_scale)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    const auto back = graph.readback(
        "picture",
        stage
            .declare(graph,
                     {.day = 0, .tile = stage.scene().size, .camera = camera, .light_scale = light_scale})
            .images.picture);
    return cv::Mat4b(executor.run(graph).mat(back)).clone();
}

/// Of the red over the green, at a point of the wall.
double redness(const cv::Mat4b& picture, const glm::dvec3& at)
{
    const double pixels_per_m = picture.cols / .18;
    const cv::Point pixel(int(picture.cols / 2 + at.x * pixels_per_m),
                          int(picture.rows / 2 - at.y * pixels_per_m));
    const cv::Scalar mean = cv::mean(picture(cv::Rect(pixel - cv::Point(2, 2), cv::Size(5, 5))));
    return mean[0] / std::max(mean[1], 1.);
}

using ManyWounds = gpu_test::Test;

} // namespace

TEST_F(ManyWounds, SixtyFourAreDrawnAndLabelledWithTheAreasOfTheirHealing)
{
    const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene_of_many()));
    ASSERT_EQ(stage.loaded().wounds.size(), 64u);
    EXPECT_THAT(stage.loaded().notes, testing::Not(testing::Contains(HasSubstr("/wounds"))));
    EXPECT_LE(stage.loaded().wounds[0].prepared().patch.color.cols, 128) << "more texels than 6 mm need";
    constexpr double later_day = 4;
    const Labelled fresh = labelled(stage, 0), later = labelled(stage, later_day);
    const auto wounds = stage.wounds_on(later_day);
    for (std::size_t i = 0; i < 64; ++i) {
        SCOPED_TRACE(i + 1);
        const glm::dvec3 at = place_of(int(i));
        EXPECT_GT(redness(fresh.picture, at), 1.15 * redness(fresh.picture, at + glm::dvec3(.01, .01, 0)));
        EXPECT_GT(fresh.sizes[i].bed_mm2, 8);
        EXPECT_NEAR(fresh.visible[i].bed_mm2 / fresh.sizes[i].bed_mm2, 1, .05);
        EXPECT_NEAR(later.sizes[i].bed_mm2 / fresh.sizes[i].bed_mm2 / (*wounds)[i].unhealed_ratio, 1, .05);
        EXPECT_NEAR(later.visible[i].bed_mm2 / later.sizes[i].bed_mm2, 1, .1);
        const cv::Rect box = fresh.visible[i].box;
        EXPECT_NEAR(box.x + .5 * box.width, 200 + at.x * 400 / .18, 3);
        EXPECT_NEAR(box.y + .5 * box.height, 200 - at.y * 400 / .18, 3);
    }
}

TEST_F(ManyWounds, LightCanBeKeptOnThem)
{
    const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene_of_many()));
    const std::optional<double> scale = stage.light_scale(camera, stage.scene().size[1]);
    ASSERT_TRUE(scale);
    const cv::Mat4b kept = drawn(stage, scale), exact = drawn(stage, {});
    cv::Mat difference;
    cv::absdiff(kept, exact, difference);
    const cv::Scalar mean = cv::mean(difference);
    EXPECT_LT(mean[0] + mean[1] + mean[2], 3 * 1.5);
    for (int i = 0; i < 64; ++i)
        EXPECT_NEAR(redness(kept, place_of(i)) / redness(exact, place_of(i)), 1, .1) << i + 1;
}

TEST_F(ManyWounds, OfNineInOnePlaceTheNearestAreDrawnAndTheUserIsToldOnce)
{
    const scene::Scene nine = scene_of_nine();
    const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(nine));
    EXPECT_EQ(std::ranges::count_if(stage.loaded().notes,
                                    [](const std::string& note) {
                                        return note.find("more than 6 wounds") != std::string::npos;
                                    }),
              1);
    const Labelled labels = labelled(stage, 0);
    EXPECT_THAT(labels.visible, testing::SizeIs(9));
    const std::optional<double> scale = stage.light_scale(camera, nine.size[1]);
    ASSERT_TRUE(scale);
    const cv::Mat4b kept = drawn(stage, scale), exact = drawn(stage, {});
    for (const cv::Mat4b& picture : {kept, exact})
        EXPECT_GT(redness(picture, {.004, 0, 0}), 1.15 * redness(picture, {.06, 0, 0}));
}

TEST(WoundSets, HoldTheWoundsWhosePatchesReachATriangle)
{
    const head::Model wall = fine_wall();
    std::vector<passes::WoundReach> reaches;
    for (int i = 0; i < 10; ++i) {
        head::Anchor anchor{};
        anchor.centre = {.001 * i, 0, 0};
        anchor.right = {1, 0, 0};
        anchor.down = {0, -1, 0};
        anchor.normal = {0, 0, 1};
        anchor.half_width_m = i == 9 ? .2 : .02;
        reaches.push_back({anchor});
    }
    const auto set_at = [&](double x) {
        for (std::size_t i = 0; i + 2 < wall.indices.size(); i += 3) {
            const auto [a, b, c] = head::corners_of(wall, i);
            const glm::vec3 middle = (a + b + c) / 3.f;
            if (std::abs(middle.x - x) < .0025 && std::abs(middle.y) < .0025)
                return passes::wounds_on(wall, i, reaches);
        }
        return passes::WoundSet{};
    };
    EXPECT_THAT(set_at(.05), ElementsAre(9)) << "beside the small ones";
    EXPECT_THAT(set_at(.02 + .006), testing::Contains(8u));
    EXPECT_THAT(set_at(-.008), ElementsAre(0, 1, 2, 3, 4, 9)) << "the nearest, in half widths";
    EXPECT_THAT(passes::drawn_near({3, 5}, {0, 0, 0}, reaches), ElementsAre(3, 5));
}

TEST(ManyWoundsLimit, IsWhatALabelCanNumber)
{
    scene::Scene scene;
    scene.wounds.resize(shared::MAX_WOUNDS);
    EXPECT_NO_THROW(scene::check(scene));
    scene.wounds.emplace_back();
    const auto refusal = [](const auto& refused) -> std::string {
        try {
            refused();
            return "accepted";
        } catch (const base::InputError& error) {
            return error.what();
        }
    };
    EXPECT_THAT(refusal([&] { scene::check(scene); }),
                testing::AllOf(HasSubstr("/wounds"), HasSubstr("holds 256"), HasSubstr("at most 255")));
    EXPECT_NO_THROW(scene::check_count(255, 8, "photo.png"));
    EXPECT_THAT(refusal([] { scene::check_count(256, 8, "photo.png"); }),
                testing::AllOf(HasSubstr("photo.png"), HasSubstr("its 8 wounds"), HasSubstr("255")));
}
