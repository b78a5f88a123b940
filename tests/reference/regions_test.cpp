#include "reference/regions.hpp"

#include <gtest/gtest.h>

#include "scenes.hpp"
#include "tests/support/small_head.hpp"

namespace {

using reference::Region;

/// A ball of another material hangs before a wall and keeps a lamp's light from it.
scene::LoadedScene wall_and_ball()
{
    head::Model model = small::wall(glm::vec3(.5f));
    model.materials.push_back(scenes::plain("other", {.5f, .5f, .5f, 1}));
    scenes::add_ball(model, {0, 0, .05f}, .02f, 1);
    scene::LoadedScene scene = scenes::scene_of(std::move(model));
    scene.lights = {{.kind = optics::LightKind::Directional,
                     .direction = cv::normalize(cv::Vec3d(1, 0, 1)),
                     .strength = {1, 1, 1}}};
    return scene;
}

cv::Mat1b region(const reference::Regions& regions, Region which)
{
    return regions[std::size_t(which)];
}

TEST(Regions, EdgesOfACastShadowAreFoundAndWhatIsNoSkinIsLeftOut)
{
    const scene::LoadedScene scene = wall_and_ball();
    const reference::Regions regions =
        reference::find_regions(scene, {.camera = {{0, 0, 1}, {0, 0, 0}, 12}, .size = {100, 100}});
    const double mm_px = 2 * std::tan(6 * std::numbers::pi / 180) * 1000 / 100;
    const auto at = [&](Region which, double x_mm) {
        return region(regions, which)(50, int(50 + x_mm / mm_px));
    };
    EXPECT_EQ(at(Region::Skin, 0), 0) << "the ball is no skin";
    EXPECT_EQ(at(Region::Skin, 60), 255);
    // The shadow's middle lies 50 mm to the left, its ends 20 * sqrt(2) mm from there.
    EXPECT_EQ(at(Region::ShadowEdges, -50), 0);
    EXPECT_EQ(at(Region::ShadowEdges, -50 - 20 * std::numbers::sqrt2), 255);
    EXPECT_EQ(at(Region::ShadowEdges, 60), 0);
    EXPECT_EQ(cv::countNonZero(region(regions, Region::Wound)), 0);
}

TEST(Regions, ThinIsWhatHasAnotherSideWithinTenMillimetres)
{
    for (const auto& [radius, thin] : {std::pair(.004f, true), std::pair(.02f, false)}) {
        head::Model model;
        model.materials = {scenes::plain("skin", {.5f, .5f, .5f, 1})};
        scenes::add_ball(model, {0, 0, 0}, radius);
        const scene::LoadedScene scene = scenes::scene_of(std::move(model));
        const reference::Regions regions =
            reference::find_regions(scene, {.camera = {{0, 0, 1}, {0, 0, 0}, 3}, .size = {32, 32}});
        EXPECT_EQ(region(regions, Region::Thin)(16, 16) == 255, thin) << radius;
        EXPECT_EQ(region(regions, Region::Skin)(16, 16), 255) << radius;
    }
}

} // namespace
