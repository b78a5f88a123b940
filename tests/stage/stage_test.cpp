// A stage that gets one scene after another: it reruns only what the difference affects, shows at once what
// is ready, and finally equals a new stage of the same scene.
#include <fstream>
#include <gmock/gmock.h>

#include "base/input_error.hpp"
#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

/// A stage drawn as a window draws it.
struct Window
{
    explicit Window(const scene::Scene& scene) : stage(gpu_test::device(), stage::Stage::prepare(scene)) {}

    graph::Graph frame(double day = 4)
    {
        graph::Graph graph;
        graph.readback(
            "picture",
            stage
                .declare(graph,
                         {.day = day, .tile = stage.scene().size, .every_frame = false, .lights_rest = false})
                .images.picture);
        return graph;
    }
    std::vector<std::string> ran() { return gpu_test::ran(executor.run(frame())); }
    cv::Mat4b picture() { return executor.run(frame()).mat({0}).clone(); }
    bool up_to_date() { return executor.up_to_date(frame()); }

    stage::Stage stage;
    gpu::Executor executor{gpu_test::device(), gpu_test::shaders()};
};

scene::Scene moved(scene::Scene scene)
{
    scene.wounds[0].place = head::FacePoint{.12, .05};
    return scene;
}

double largest_difference(const cv::Mat4b& a, const cv::Mat4b& b)
{
    return cv::norm(a, b, cv::NORM_INF);
}

using StageTest = gpu_test::Test;

} // namespace

TEST_F(StageTest, ANewDayDrawsThePictureOnlyWhereTheWoundIs)
{
    for (const std::uint32_t samples : {1u, 4u}) {
        scene::Scene scene = small::scene(small::head());
        scene.samples = samples;
        Window window(scene);
        window.executor.measure({.check_regions = true}); // throws where the picture is not the whole frame's
        window.executor.run(window.frame(0));
        for (const double day : {2.5, 9., 30., 200., 1.}) {
            const gpu::FrameResult frame = window.executor.run(window.frame(day));
            EXPECT_LT(frame.pass("forward").work.refreshed, .3) << "day " << day;
            EXPECT_GT(frame.pass("forward").work.refreshed, 0) << "day " << day;
        }
    }
}

TEST_F(StageTest, RunsNothingWhenTheSceneIsTheSame)
{
    Window window(small::scene(small::head()));
    EXPECT_FALSE(window.up_to_date());
    window.ran();
    EXPECT_TRUE(window.up_to_date());
    window.stage.update(window.stage.scene());
    EXPECT_FALSE(window.stage.pending());
    EXPECT_TRUE(window.up_to_date());
    EXPECT_THAT(window.ran(), testing::IsEmpty());
}

TEST_F(StageTest, RerunsOnlyPassesThatADifferenceAffects)
{
    Window window(small::scene(small::head()));
    window.ran();
    scene::Scene scene = window.stage.scene();
    const auto after = [&](const auto& edit) {
        edit(scene);
        window.stage.update(scene);
        EXPECT_FALSE(window.stage.pending());
        return window.ran();
    };
    EXPECT_THAT(after([](scene::Scene& s) { s.camera.from.azimuth_deg += 5; }),
                UnorderedElementsAre("forward", "tonemap"));
    EXPECT_THAT(after([](scene::Scene& s) { s.lights[1].intensity *= .5; }),
                UnorderedElementsAre("forward", "tonemap"));
    EXPECT_THAT(after([](scene::Scene& s) { s.lights[0].from.azimuth_deg += 5; }),
                UnorderedElementsAre("shadow", "forward", "tonemap"));
    EXPECT_THAT(after([](scene::Scene& s) { s.exposure_stops = .5; }), UnorderedElementsAre("tonemap"));
    EXPECT_THAT(after([](scene::Scene& s) { s.tissue = "dark"; }),
                UnorderedElementsAre("reflectance_lut", "forward", "tonemap"));
    EXPECT_THAT(after([](scene::Scene& s) { s.shading.ward = false; }),
                UnorderedElementsAre("forward", "tonemap"));
}

TEST_F(StageTest, ShowsAMovedWoundAtOnceAndFinallyEqualsANewStage)
{
    const scene::Scene scene = small::scene(small::head());
    Window window(scene);
    const cv::Mat4b before = window.picture();
    window.stage.update(moved(scene));
    EXPECT_TRUE(window.stage.pending());
    EXPECT_THAT(window.ran(), UnorderedElementsAre("forward", "tonemap"))
        << "the wound's maps and the shadow are unchanged";
    EXPECT_GT(largest_difference(window.picture(), before), 30) << "the wound is elsewhere";

    window.stage.wait_until_complete();
    EXPECT_FALSE(window.stage.pending());
    Window fresh(moved(scene));
    EXPECT_EQ(largest_difference(window.picture(), fresh.picture()), 0);

    window.stage.update(scene); // undo
    EXPECT_FALSE(window.stage.pending()) << "the previous place is still loaded";
    EXPECT_EQ(largest_difference(window.picture(), before), 0);
}

TEST_F(StageTest, ALongDragIsUndoneAtOnceAndFinallyEqualsANewStage)
{
    const scene::Scene scene = small::scene(small::head());
    Window window(scene);
    const cv::Mat4b before = window.picture();
    scene::Scene dragged = scene;
    for (int i = 0; i < 40; ++i) { // more places than a loader keeps
        dragged.wounds[0].place = head::FacePoint{.3 - .005 * i, -.15};
        window.stage.update(dragged, true);
        EXPECT_TRUE(window.stage.pending());
        EXPECT_GT(i % 10 == 0 ? largest_difference(window.picture(), before) : 255, 30) << i;
    }
    window.stage.wait_until_complete();
    Window fresh(dragged);
    EXPECT_EQ(largest_difference(window.picture(), fresh.picture()), 0);
    window.stage.update(scene);
    EXPECT_FALSE(window.stage.pending());
    EXPECT_EQ(largest_difference(window.picture(), before), 0);
}

TEST_F(StageTest, ChangesOfWidthRollDepthAndHealingFinallyEqualANewStage)
{
    scene::Scene scene = small::scene(small::head());
    Window window(scene);
    scene.wounds[0].width_mm = 22;
    scene.wounds[0].roll_deg = 40;
    scene.wounds[0].depth_factor = .5;
    scene.wounds[0].healing.curve.delta *= 2;
    window.stage.update(scene);
    window.picture();
    window.stage.wait_until_complete();
    Window fresh(scene);
    EXPECT_EQ(largest_difference(window.picture(), fresh.picture()), 0);
}

TEST_F(StageTest, WoundsCanBeAddedAndRemoved)
{
    const scene::Scene one = small::scene(small::head());
    scene::Scene two = one;
    two.wounds.push_back({});
    two.wounds[1].place = std::string("forehead");
    two.wounds[1].kind = "laceration";
    Window window(one);
    const cv::Mat4b before = window.picture();
    window.stage.update(two);
    EXPECT_EQ(window.stage.loaded().wounds.size(), 1u) << "the new one is not ready";
    window.picture();
    window.stage.wait_until_complete();
    ASSERT_EQ(window.stage.loaded().wounds.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(window.stage.loaded().wounds[i].scene_wound, i);
    Window fresh(two);
    EXPECT_EQ(largest_difference(window.picture(), fresh.picture()), 0);

    scene::Scene other = two;
    other.wounds.erase(other.wounds.begin());
    window.stage.update(other);
    EXPECT_FALSE(window.stage.pending());
    EXPECT_GT(largest_difference(window.picture(), before), 30);
    window.stage.update(one);
    EXPECT_EQ(largest_difference(window.picture(), before), 0);
}

TEST_F(StageTest, AnotherHeadReplacesTheOldOneWhenItIsReady)
{
    const scene::Scene scene = small::scene(small::head());
    scene::Scene wall = scene;
    wall.head = small::saved(small::wall({.5f, .4f, .3f}));
    wall.wounds[0].place = glm::dvec3(.01, .02, 0);
    Window window(scene);
    const cv::Mat4b before = window.picture();
    window.stage.update(wall);
    EXPECT_EQ(largest_difference(window.picture(), before), 0) << "the old picture stays";
    window.stage.wait_until_complete();
    Window fresh(wall);
    EXPECT_EQ(largest_difference(window.picture(), fresh.picture()), 0);
}

TEST_F(StageTest, ErrorsLeaveTheStageUnchanged)
{
    const TemporaryFolder folder;
    const scene::Scene good = small::scene(small::head());
    Window window(good);
    const cv::Mat4b before = window.picture();
    std::ofstream(folder / "broken.png") << "no picture";
    std::ofstream(folder / "broken.glb") << "no head";
    std::ofstream(folder / "broken.json") << "{";
    const auto error = [&](const auto& edit) -> std::string {
        scene::Scene bad = good;
        bad.lights[0].intensity = 9; // no part of a refused scene may be shown
        edit(bad);
        try {
            window.stage.update(bad);
            window.stage.wait_until_complete();
        } catch (const base::InputError& refused) {
            EXPECT_EQ(window.stage.scene(), good);
            EXPECT_FALSE(window.stage.pending());
            EXPECT_EQ(largest_difference(window.picture(), before), 0);
            return refused.what();
        }
        return "accepted";
    };
    EXPECT_THAT(error([&](scene::Scene& s) { s.wounds[0].photo = folder / "broken.png"; }),
                HasSubstr("broken.png"));
    EXPECT_THAT(error([&](scene::Scene& s) { s.wounds[0].photo = folder / "absent.png"; }),
                HasSubstr("absent.png"));
    EXPECT_THAT(error([&](scene::Scene& s) { s.head = folder / "broken.glb"; }), HasSubstr("broken.glb"));
    EXPECT_THAT(error([&](scene::Scene& s) { s.tissue = folder / "broken.json"; }), HasSubstr("broken.json"));
    EXPECT_THAT(error([](scene::Scene& s) {
                    s.wounds[0].place = head::FacePoint{2, 2};
                }),
                HasSubstr("miss the head"));
    EXPECT_THAT(error([](scene::Scene& s) { s.wounds[0].place = std::string("toe"); }), HasSubstr("toe"));
    EXPECT_THAT(error([](scene::Scene& s) { s.wounds[0].healing.curve.gamma = 99; }), HasSubstr("gamma"));
    EXPECT_THAT(error([](scene::Scene& s) { s.wounds.resize(256); }), HasSubstr("255"));
    EXPECT_THAT(error([](scene::Scene& s) { s.lights.resize(9); }), HasSubstr("lights"));
    EXPECT_THAT(error([](scene::Scene& s) { s.days.clear(); }), HasSubstr("days"));
}
