// Editing of scenes: picking, camera moves, undo, two settings side by side, saving.
#include <cmath>
#include <gmock/gmock.h>

#include "apps/demo/camera_moves.hpp"
#include "apps/demo/history.hpp"
#include "head/surface.hpp"
#include "scene/command_line.hpp"
#include "scene/file.hpp"
#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using testing::Contains;
using testing::UnorderedElementsAre;

/// Position of a point in the picture, -1 to 1 from left to right and from top to bottom.
glm::dvec2 seen_at(const stage::Stage& stage, const head::Camera& camera, const passes::ViewportTile& canvas,
                   const glm::dvec3& point)
{
    const glm::dvec4 clip = glm::dmat4(stage.view(camera, canvas).clip_from_world) * glm::dvec4(point, 1);
    return glm::dvec2(clip.x, clip.y) / clip.w;
}

using EditTest = gpu_test::Test;

} // namespace

TEST_F(EditTest, PickingWhereAWoundIsSeenFindsItsCentre)
{
    scene::Scene scene = small::scene(small::head());
    scene.size = {320, 200};
    scene.wounds.push_back({});
    scene.wounds[1].place = std::string("forehead");
    stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
    const passes::ViewportTile canvas(scene.size);
    for (std::size_t i : {0, 1}) {
        const glm::dvec3 centre = stage.loaded().wounds[i].anchor.centre;
        const glm::dvec2 at = seen_at(stage, stage.loaded().camera(), canvas, centre);
        const auto picked = stage.loaded().pick(stage.loaded().camera(), at.x, at.y, canvas.aspect());
        ASSERT_TRUE(picked);
        EXPECT_LT(glm::distance(*picked, centre), 1e-5);
        EXPECT_EQ(stage.loaded().wound_near(*picked), i);
        scene.wounds[i].place = *picked; // a wound placed there must not move
        stage.update(scene);
        EXPECT_LT(glm::distance(stage.loaded().wounds[i].anchor.centre, centre), 1e-5);
    }
    EXPECT_FALSE(stage.loaded().pick(stage.loaded().camera(), -.99, -.99, canvas.aspect()))
        << "outside the head";
    const auto chin = stage.loaded().pick(stage.loaded().camera(), 0, .8, canvas.aspect());
    ASSERT_TRUE(chin);
    EXPECT_FALSE(stage.loaded().wound_near(*chin));
}

TEST_F(EditTest, DraggingMovesAWoundWithoutJumps)
{
    const head::Model head = small::head();
    const head::Bvh bvh(head);
    const head::FaceFrame face = head::find_face(head);
    glm::dvec3 last(0);
    for (int i = 0; i <= 200; ++i) { // 5 cm over cheek and nose, in quarter millimetres
        const auto seen = head::first_on_ray(bvh, {-.025 + i * 2.5e-4, .01, 1}, {0, 0, -1});
        ASSERT_TRUE(seen);
        const head::Anchor anchor = head::anchor_wound(head, bvh, face, seen->at, 60, 0, "wound");
        EXPECT_LT(glm::distance(anchor.centre, seen->at), 1e-9) << "under the pointer";
        EXPECT_LT(i == 0 ? 0 : glm::length(anchor.normal - last), .05) << i;
        last = anchor.normal;
    }
}

TEST(Surface, NearestPointIsInsideATriangleOrOnItsBorder)
{
    const head::Model wall = small::wall({.5f, .4f, .3f});
    const auto near = [&](double x, double y, double z) {
        return head::nearest_on_surface(wall, {x, y, z}).at;
    };
    EXPECT_LT(glm::distance(near(.013, -.037, .02), glm::dvec3(.013, -.037, 0)), 1e-9);
    EXPECT_LT(glm::distance(near(.5, .5, .1), glm::dvec3(.12, .12, 0)), 1e-7) << "a corner";
    EXPECT_LT(glm::distance(near(.013, -.5, -.1), glm::dvec3(.013, -.12, 0)), 1e-7) << "an edge";
    EXPECT_FALSE(head::first_on_ray(head::Bvh(wall), {0, 0, -1}, {0, 0, 1})) << "a back face";
}

TEST(CameraMoves, StayWithinTheLimitsOfASceneFile)
{
    scene::Camera camera;
    camera = demo_command::orbit(camera, 200, 500);
    EXPECT_DOUBLE_EQ(camera.from.azimuth_deg, 218 - 360);
    EXPECT_DOUBLE_EQ(camera.from.elevation_deg, 89);
    EXPECT_DOUBLE_EQ(demo_command::zoom(camera, 2, .8).distance_m, .4);
    EXPECT_GT(demo_command::zoom(camera, 1e9, .8).distance_m, 0) << "0 would mean an automatic distance";
    EXPECT_LE(demo_command::pan(camera, 1e6, 0, .8).target_m[0], 1);
}

TEST_F(EditTest, PanningMovesTheHeadWithTheMouse)
{
    scene::Scene scene = small::scene(small::head());
    const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
    const passes::ViewportTile canvas(scene.size);
    const scene::Camera from = scene.camera;
    const glm::dvec3 middle = stage.loaded().camera(from).target;
    const scene::Camera moved = demo_command::pan(from, .1, .05, stage.loaded().distance(from));
    const glm::dvec2 at = seen_at(stage, stage.loaded().camera(moved), canvas, middle); // picture height: 2
    EXPECT_NEAR(at.x, .2, 1e-5);
    EXPECT_NEAR(at.y, .1, 1e-5);
}

TEST(HistoryTest, ADragIsOneStep)
{
    scene::Scene scene;
    demo_command::History history(scene);
    EXPECT_FALSE(history.can_undo());
    for (int i = 0; i < 20; ++i) {
        scene.wounds[0].roll_deg += 1;
        history.edit(scene, "turn wound 1");
    }
    history.settle();
    scene.wounds[0].roll_deg += 1;
    history.edit(scene, "turn wound 1");
    scene.exposure_stops = 1;
    history.edit(scene, "exposure");
    history.edit(scene, "exposure");
    EXPECT_EQ(history.undo().exposure_stops, 0);
    EXPECT_EQ(history.undo().wounds[0].roll_deg, 20);
    EXPECT_EQ(history.undo(), scene::Scene{});
    EXPECT_EQ(history.undo(), scene::Scene{}) << "there is no earlier state";
    EXPECT_EQ(history.redo().wounds[0].roll_deg, 20);
    scene = history.now();
    scene.tissue = "dark";
    history.edit(scene, "tissue");
    EXPECT_FALSE(history.can_redo()) << "undone edits are dropped";
    EXPECT_EQ(history.undo().wounds[0].roll_deg, 20);
}

TEST_F(EditTest, TwoSettingsAreShownSideBySide)
{
    const scene::Scene scene = small::scene(small::head());
    scene::Scene other = scene;
    scene::make_published(other);
    stage::Stage left(gpu_test::device(), stage::Stage::prepare(scene));
    stage::Stage right = left;
    right.update(other);
    right.wait_until_complete();
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const auto single = [&](stage::Stage& stage, double day) {
        graph::Graph graph;
        graph.readback(
            "picture",
            stage.declare(graph, {.day = day, .tile = scene.size, .every_frame = false}).images.picture);
        return executor.run(graph).mat({0}).clone();
    };
    const auto both = [&](double divider) {
        graph::Graph graph;
        graph.readback("picture", stage::declare_split(
                                      graph, left, {.day = 3, .tile = scene.size, .every_frame = false},
                                      right, {.day = 9, .tile = scene.size, .every_frame = false}, divider));
        return executor.run(graph);
    };
    const cv::Mat first = single(left, 3), second = single(right, 9);
    ASSERT_GT(cv::norm(first, second, cv::NORM_INF), 30);
    EXPECT_THAT(gpu_test::ran(both(.25)),
                testing::AllOf(Contains("forward"), Contains("right forward"), Contains("split")));
    for (const double divider : {0., .3, .6, 1.}) {
        const gpu::FrameResult frame = both(divider);
        EXPECT_THAT(gpu_test::ran(frame), UnorderedElementsAre("split")) << "nothing else has changed";
        const int border = cvRound(divider * first.cols);
        const cv::Range before(0, border), after(border, first.cols);
        EXPECT_EQ(border == 0 ? 0 : cv::norm(frame.mat({0}).colRange(before), first.colRange(before)), 0);
        EXPECT_EQ(border == first.cols ? 0 : cv::norm(frame.mat({0}).colRange(after), second.colRange(after)),
                  0);
    }
}

TEST(SavedScene, ReadsBackEqual)
{
    const TemporaryFolder folder;
    scene::Scene scene;
    scene.head = folder / "heads" / "a.glb";
    scene.tissue = (folder / "tissue.json").string();
    scene::make_published(scene);
    scene.tissue = "medium";
    scene.wounds[0].photo = "/elsewhere/photo.png";
    scene.wounds[0].segmentation.rect = cv::Rect(1, 2, 30, 40);
    scene.wounds[0].place = glm::dvec3(.1, 1. / 3, -.02);
    scene.wounds[0].healing.curve.delta = .1234567890123;
    scene.wounds.push_back({});
    scene.wounds[1].photo = folder / "b.png";
    scene.wounds[1].mask = folder / "mask.png";
    scene.wounds[1].place = head::FacePoint{.1, -.2};
    scene.camera.target_m = {.01, -.02, 0};
    scene.views = {{"near", scene.camera}, {"left", std::nullopt}};
    scene.shading.ambient = base::Color(.1, .2, .3);
    scene.days = {0, .5, 400};
    scene.samples = 4;
    const std::filesystem::path file = folder / "saved.json";
    scene::save_scene(file, scene);
    EXPECT_EQ(scene::read_scene(file), scene);
    scene::save_scene(file, scene::Scene{});
    EXPECT_EQ(scene::read_scene(file), scene::Scene{});
}
