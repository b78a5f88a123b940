// Effects of the demo's gestures on a scene, without a window.
#include "apps/demo/edit.hpp"

#include <gtest/gtest.h>

#include "stage/stage.hpp"

namespace {

/// A camera 1 m in front of a 30 mm wound at the origin that faces the camera.
struct Facing
{
    Facing()
    {
        passes::Head head;
        head.min = glm::vec3(-.1f);
        head.max = glm::vec3(.1f);
        sight = demo_command::Sight(
            passes::make_view({{0, 0, 1}, {0, 0, 0}, 20}, head, passes::ViewportTile({200, 100})));
        anchor.half_width_m = .015 / .45; // of the patch; the wound takes .45 of it
    }
    demo_command::Sight sight;
    head::Anchor anchor;
};

TEST(Sight, ProjectsAndUnprojects)
{
    const Facing on;
    EXPECT_NEAR(glm::distance(on.sight.project({0, 0, 0}).value(), glm::dvec2(.5)), 0, 1e-6);
    const auto at = on.sight.project({.02, .03, 0});
    ASSERT_TRUE(at);
    EXPECT_GT(at->x, .5);
    EXPECT_LT(at->y, .5) << "up";
    const auto back = on.sight.on_plane(*at, {0, 0, 0}, {0, 0, 1});
    ASSERT_TRUE(back);
    EXPECT_NEAR(glm::distance(*back, glm::dvec3(.02, .03, 0)), 0, 1e-6);
    EXPECT_FALSE(on.sight.project({0, 0, 2})) << "behind the camera";
    EXPECT_FALSE(on.sight.on_plane({.5, .5}, {0, .1, 0}, {0, 1, 0})) << "parallel to the plane";
}

TEST(WoundOutline, HasItsHandlesRightAndAbove)
{
    Facing on;
    const auto outline = demo_command::outline_of(on.anchor, on.sight);
    ASSERT_TRUE(outline);
    EXPECT_TRUE(outline->facing);
    EXPECT_TRUE(demo_command::inside(*outline, {.5, .5}));
    EXPECT_FALSE(demo_command::inside(*outline, outline->roll_handle));
    EXPECT_GT(outline->width_handle.x, outline->centre.x);
    EXPECT_LT(outline->roll_handle.y, outline->centre.y);
    on.anchor.normal = {0, 0, -1};
    EXPECT_FALSE(demo_command::inside(demo_command::outline_of(on.anchor, on.sight).value(), {.5, .5}))
        << "seen from behind";
}

TEST(WoundHandles, SetWidthAndRoll)
{
    const Facing on;
    const auto outline = demo_command::outline_of(on.anchor, on.sight);
    ASSERT_TRUE(outline);
    EXPECT_NEAR(demo_command::dragged_width_mm(on.anchor, on.sight, outline->width_handle, 1), 30, 1e-3)
        << "at its current position";
    EXPECT_NEAR(demo_command::dragged_width_mm(on.anchor, on.sight, *on.sight.project({0, .03, 0}), 1), 60,
                1e-3);
    EXPECT_NEAR(demo_command::dragged_roll_deg(on.anchor, on.sight, outline->roll_handle, 10), 10, 1e-3)
        << "at its current position";
    EXPECT_NEAR(demo_command::dragged_roll_deg(on.anchor, on.sight, *on.sight.project({-.03, 0, 0}), 10), 100,
                1e-3)
        << "counter-clockwise";
}

TEST(PublishedMode, CanBeSwitchedOnAndOff)
{
    const scene::Scene corrected;
    scene::Scene scene = corrected;
    EXPECT_FALSE(demo_command::is_published(scene));
    demo_command::set_published(scene, true, corrected);
    EXPECT_TRUE(demo_command::is_published(scene));
    demo_command::set_published(scene, false, corrected);
    EXPECT_EQ(scene, corrected);
}

TEST(PublishedMode, KeepsEditsMadeMeanwhile)
{
    const scene::Scene corrected;
    scene::Scene scene = corrected;
    demo_command::set_published(scene, true, corrected);
    scene.lights.front().from.azimuth_deg = 50;
    scene.wounds.front().width_mm = 40;
    demo_command::set_published(scene, false, corrected);
    EXPECT_EQ(scene.lights.front().from.azimuth_deg, 50);
    EXPECT_EQ(scene.lights.size(), corrected.lights.size());
    EXPECT_EQ(scene.wounds.front().width_mm, 40);
}

TEST(NextWound, DiffersFromTheExistingOnes)
{
    scene::Scene scene;
    const scene::Wound second = demo_command::next_wound(scene);
    EXPECT_NE(second.seed, scene.wounds.front().seed);
    scene.wounds.push_back(second);
    EXPECT_NE(demo_command::next_wound(scene).seed, second.seed);
}

} // namespace
