// A photograph with several wounds in a scene: all wounds are placed on the head as in the photograph.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/wound_photographs.hpp"

namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Disc
{
    cv::Point at;
    int radius;
};

/// 300 x 300 pixels of skin with red discs, as a scene's wound.
class SeveralWounds : public gpu_test::Test
{
  protected:
    scene::Wound wound_of(const std::vector<Disc>& discs)
    {
        auto photo = testing_wounds::photograph({300, 300}, {0, 0}, [&](double x, double y) {
            double least = 2;
            for (const Disc& disc : discs)
                least = std::min(least, std::hypot(x - disc.at.x, y - disc.at.y) / disc.radius);
            return least;
        });
        const std::string suffix = fmt::format("{}.png", ++count_);
        scene::Wound wound;
        wound.photo = folder_ / ("photo" + suffix);
        wound.mask = folder_ / ("mask" + suffix);
        base::write_png(wound.photo, photo.srgb);
        base::write_png(wound.mask, photo.mask);
        return wound;
    }
    static std::string refusal(const scene::Scene& scene)
    {
        try {
            const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
            return "accepted";
        } catch (const base::InputError& error) {
            return error.what();
        }
    }

    TemporaryFolder folder_;
    int count_ = 0;
};

} // namespace

TEST_F(SeveralWounds, LieOnTheHeadAsInThePhotograph)
{
    scene::Scene scene = small::scene(small::wall({.55F, .36F, .27F}));
    scene.wounds = {scene::Wound{}, wound_of({{{110, 150}, 30}, {{200, 150}, 15}, {{110, 60}, 12}})};
    scene.wounds[0].place = glm::dvec3(0, .09, 0);
    scene.wounds[1].place = glm::dvec3(0);
    scene.wounds[1].width_mm = 20; // 59 pixels
    scene.wounds[1].roll_deg = 30;
    const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
    std::vector<std::size_t> scene_wounds;
    for (const scene::PlacedWound& wound : stage.loaded().wounds)
        scene_wounds.push_back(wound.scene_wound);
    EXPECT_THAT(scene_wounds, testing::ElementsAre(0, 1, 1, 1));
    const std::vector<head::Anchor> anchors = stage.loaded().anchors();
    ASSERT_EQ(anchors.size(), 4U);

    const double mm = 20. / 59, turn = glm::radians(30.);
    const glm::dvec3 right(std::cos(turn), std::sin(turn), 0), down(std::sin(turn), -std::cos(turn), 0);
    const auto expect_near = [](const glm::dvec3& a, const glm::dvec3& b, double off) {
        EXPECT_LT(glm::distance(a, b), off) << a.x << " " << a.y << " " << a.z;
    };
    expect_near(anchors[1].centre, glm::dvec3(0), 1e-9);
    expect_near(anchors[2].centre, 90 * mm * 1e-3 * right, 2e-4);
    expect_near(anchors[3].centre, -90 * mm * 1e-3 * down, 2e-4);
    for (int i : {1, 2, 3}) {
        expect_near(anchors[i].right, right, 1e-6);
        expect_near(anchors[i].down, down, 1e-6);
    }
    EXPECT_NEAR(anchors[2].half_width_m / anchors[1].half_width_m, .5, .02);
}

TEST_F(SeveralWounds, AreFoundWithoutAMask)
{
    scene::Scene scene = small::scene(small::wall({.55F, .36F, .27F}));
    scene.wounds = {wound_of({{{110, 150}, 30}, {{200, 150}, 15}})};
    scene.wounds[0].place = glm::dvec3(0);
    scene.wounds[0].mask.clear();
    const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
    ASSERT_EQ(stage.loaded().anchors().size(), 2U);
    EXPECT_NEAR(stage.loaded().wounds[1].anchor.centre.x, 1e-3 * 90 * scene.wounds[0].width_mm / 59, 5e-4);
}

TEST_F(SeveralWounds, FollowTheHeadsSurface)
{
    scene::Scene scene = small::scene(small::head());
    scene.wounds = {wound_of({{{110, 150}, 40}, {{200, 150}, 25}})};
    scene.wounds[0].place = head::FacePoint{.2, -.1};
    const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
    const std::vector<head::Anchor> anchors = stage.loaded().anchors();
    ASSERT_EQ(anchors.size(), 2U);
    const head::Anchor &first = anchors[0], &second = anchors[1];
    EXPECT_GT(second.centre.x, first.centre.x + .015) << "further round the head";
    EXPECT_LT(second.centre.z, first.centre.z - .002);
    EXPECT_GT(second.normal.x, first.normal.x + .05);
    EXPECT_NEAR(glm::dot(second.right, second.normal), 0, 1e-9);
    EXPECT_NEAR(glm::length(second.right), 1, 1e-9);
    EXPECT_GT(glm::dot(second.right, first.right), .7);
    EXPECT_GT(glm::dot(second.down, first.down), .9);
}

TEST_F(SeveralWounds, AreAllVisibleAtTheirPositions)
{
    scene::Scene scene = small::scene(small::wall({.55F, .36F, .27F}));
    scene.wounds = {wound_of({{{110, 150}, 30}, {{200, 150}, 15}})};
    scene.wounds[0].place = glm::dvec3(0);
    const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
    const auto redness = [&](double x_m) { // at a point of the wall, on day 0
        graph::Graph graph;
        const head::Camera camera{{x_m, 0, .5}, {x_m, 0, 0}, 1};
        const graph::ReadbackId back = graph.readback(
            "picture",
            stage.declare(graph, {.day = 0, .tile = scene.size, .camera = camera, .shading = scene.shading})
                .images.picture);
        gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
        const cv::Scalar mean = cv::mean(executor.run(graph).mat(back));
        return mean[0] / std::max(mean[1], 1.);
    };
    const double mm = 30. / 59;
    EXPECT_GT(redness(0), 2);
    EXPECT_GT(redness(90 * mm * 1e-3), 2);
    EXPECT_LT(redness(55 * mm * 1e-3), 1.7) << "skin between them";
    EXPECT_LT(redness(-90 * mm * 1e-3), 1.7) << "skin where no wound is";
}

TEST_F(SeveralWounds, WhoseOthersMissTheHeadAreRefused)
{
    scene::Scene scene = small::scene(small::wall({.55F, .36F, .27F}));
    std::vector<Disc> discs;
    for (int i = 0; i < 8; ++i)
        discs.push_back({{40 + 70 * (i % 4), 60 + 100 * (i / 4)}, 14});
    scene.wounds = {wound_of(discs)};
    scene.wounds[0].place = glm::dvec3(0);
    scene.wounds[0].width_mm = 5;
    EXPECT_EQ(refusal(scene), "accepted");
    scene.wounds[0].width_mm = 60; // the other wounds lie outside the wall
    EXPECT_THAT(refusal(scene), AllOf(HasSubstr("component"), HasSubstr("no skin"), HasSubstr("width_mm")));
}

TEST_F(SeveralWounds, HintsOfASceneReachTheSegmentation)
{
    scene::Scene scene = small::scene(small::wall({.55F, .36F, .27F}));
    scene.wounds = {wound_of({{{90, 150}, 30}, {{220, 150}, 30}})};
    scene::Wound& wound = scene.wounds[0];
    wound.place = glm::dvec3(0);
    wound.mask.clear();
    for (const int x : {90, 220}) {
        wound.segmentation.rect = cv::Rect(x - 40, 110, 80, 80);
        const scene::LoadedScene loaded = scene::load(scene);
        ASSERT_EQ(loaded.wounds.size(), 1U);
        EXPECT_NEAR(loaded.wounds[0].prepared().photo_center.x, x, 3);
    }
    wound.segmentation.rect = cv::Rect(250, 250, 80, 80);
    EXPECT_THAT(refusal(scene), AllOf(HasSubstr(wound.photo.string()), HasSubstr("rectangle")));
}
