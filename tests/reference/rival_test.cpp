// The systems that the paper compares with, where their light is known: flat skin under even light, a ball
// beside the reference's own walks, and what each keeps between frames.
#include "reference/rival.hpp"

#include <gtest/gtest.h>
#include <numbers>

#include "scenes.hpp"

namespace {

using reference::Rival;
using reference::RivalMethod;

constexpr std::array all_methods{RivalMethod::Jensen, RivalMethod::DonnerJensen, RivalMethod::Li};
const glm::vec4 skin_colour(.6f, .45f, .4f, 1);

scene::LoadedScene lit(head::Model model, const cv::Vec3d& towards)
{
    scene::LoadedScene scene = scenes::scene_of(std::move(model), .9);
    scene.scene.shading.ward = false;
    scene.lights = {
        {.kind = optics::LightKind::Directional, .direction = cv::normalize(towards), .strength = {1, 1, 1}}};
    return scene;
}

scene::LoadedScene lit_card(const cv::Vec3d& towards = {0, 0, 1})
{
    head::Model model;
    model.materials = {scenes::plain("skin", skin_colour)};
    scenes::add_card(model, {0, 0, 0}, .03f, 0);
    return lit(std::move(model), towards);
}

scene::LoadedScene lit_ball(float radius, const cv::Vec3d& towards)
{
    head::Model model;
    model.materials = {scenes::plain("skin", skin_colour)};
    scenes::add_ball(model, {0, 0, 0}, radius, 0, 48);
    return lit(std::move(model), towards);
}

/// Looks from +z at a square of `width` metres around the origin.
head::Camera near_camera(double width)
{
    return {
        .eye = {0, 0, 1}, .target = {0, 0, 0}, .fov_deg = 2 * std::atan(width / 2) * 180 / std::numbers::pi};
}

cv::Vec4d mean_of(const cv::Mat4f& picture)
{
    const cv::Scalar mean = cv::mean(picture);
    return {mean[0], mean[1], mean[2], mean[3]};
}

TEST(Rival, FlatSkinUnderEvenLightReturnsItsAlbedo)
{
    const scene::LoadedScene scene = lit_card();
    for (const RivalMethod method : all_methods) {
        Rival rival(method);
        const bool noisy = method == RivalMethod::Li;
        const cv::Mat4f picture = rival.draw(scene, near_camera(.004), {16, 16}, 0, noisy ? 4 : 1);
        const cv::Vec4d mean = mean_of(picture);
        for (int c = 0; c < 3; ++c) {
            const double expected = .9 * double(skin_colour[c]);
            EXPECT_NEAR(mean[c], expected, (noisy ? .02 : .015) * expected) << int(method) << ' ' << c;
            if (noisy)
                continue;
            double least = 10, most = 0; // the samples' pattern does not show
            for (const cv::Vec4f& pixel : picture) {
                least = std::min(least, double(pixel[c]));
                most = std::max(most, double(pixel[c]));
            }
            EXPECT_LT(most - least, .02 * expected) << int(method) << ' ' << c;
        }
        EXPECT_EQ(mean[3], 1);
    }
}

TEST(Rival, BallIsNearTheReferencesWalks)
{
    const scene::LoadedScene scene = lit_ball(.02f, {.6, 0, .8});
    const scenes::Tracer truth(scene, {.bounces = 0, .ambient = false, .specular = false});
    std::array<Rival, 3> rivals{Rival(all_methods[0]), Rival(all_methods[1]), Rival(all_methods[2])};
    for (const double x : {-.011, .004}) { // near the terminator, and .9 of full light
        const scenes::Tracer::Mean walked = truth.along({x, 0, 1}, {0, 0, -1}, 1500);
        head::Camera camera = near_camera(.0004);
        camera.eye.x = camera.target.x = x;
        for (Rival& rival : rivals) {
            const cv::Vec4d mean = mean_of(rival.draw(scene, camera, {4, 4}, 0, 4));
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(mean[c], walked.light[c], .06 * walked.light[c] + .01)
                    << &rival - rivals.data() << ' ' << c << ' ' << x;
        }
    }
}

TEST(Rival, KeepsWhatItsMethodAllows)
{
    scene::LoadedScene scene = lit_ball(.01f, {0, 0, 1});
    head::Camera camera = near_camera(.02);
    Rival rival(RivalMethod::Jensen);
    const auto draw = [&](double day) { return rival.draw(scene, camera, {8, 8}, day, 1); };
    const cv::Mat4f first = draw(0);
    EXPECT_EQ(rival.work(), (Rival::Work{1, 1, 1, 1}));
    draw(0);
    EXPECT_EQ(rival.work(), (Rival::Work{1, 1, 1, 1})) << "nothing has changed";
    camera.eye.x = .1;
    draw(0);
    EXPECT_EQ(rival.work(), (Rival::Work{1, 1, 1, 2})) << "the camera";
    camera.eye.x = 0;
    scene.lights[0].strength *= 2;
    const cv::Mat4f brighter = draw(0);
    EXPECT_EQ(rival.work(), (Rival::Work{1, 1, 2, 3})) << "the light";
    EXPECT_NEAR(double(brighter(4, 4)[1]), 2 * double(first(4, 4)[1]), 1e-4);
    draw(3);
    EXPECT_EQ(rival.work(), (Rival::Work{1, 2, 3, 4})) << "the day";
    EXPECT_GT(rival.bytes(), 1000u);
}

TEST(SurfaceLight, CoversTheSurfaceAndTheTreeIsNearTheSumOverAllSamples)
{
    constexpr double radius = .01;
    const scene::LoadedScene scene = lit_ball(float(radius), {0, 0, 1});
    reference::Levels levels;
    levels.subsurface = levels.ambient = false;
    const reference::Traceable traceable(scene, levels, 0);
    reference::SurfaceLight light(scene, 5e-4);
    EXPECT_NEAR(light.area_m2(), 4 * std::numbers::pi * radius * radius, 1e-3 * light.area_m2());
    light.illuminate(traceable.surfaces, traceable.tracer, 1);
    const optics::Dipole dipole({.9, 1e3, 1});
    const auto profile = [&](double r2) {
        const double at = dipole.at_squared(r2);
        return base::Color(at, at, at);
    };
    for (const glm::dvec3& at : {glm::dvec3(0, 0, radius), {0, radius, 0}, {.006, 0, .008}}) {
        const double whole = light.gathered(at, 1, 0, profile)[0];
        EXPECT_GT(whole, 0);
        EXPECT_NEAR(light.gathered(at, 1, .05, profile)[0], whole, .01 * whole);
        EXPECT_NEAR(light.gathered(at, 14 / dipole.sources.transport, .05, profile)[0], whole, .01 * whole);
    }
    EXPECT_FALSE(light.depth({0, 0, radius - .001}, .002));
    EXPECT_NEAR(light.depth({0, 0, radius - .003}, .002).value_or(0), .003, 1e-4);
}

} // namespace
