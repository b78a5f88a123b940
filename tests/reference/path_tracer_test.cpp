// Light in scenes that can be worked out by hand.
#include "reference/path_tracer.hpp"

#include <gtest/gtest.h>

#include "scenes.hpp"
#include "wound/optics/specular.hpp"
#include "tests/support/small_head.hpp"

namespace {

using reference::Levels;
using scenes::Tracer;

const glm::vec4 grey(.5f, .5f, .5f, 1), white(1, 1, 1, 1);
constexpr Levels direct{
    .shadows = true, .bounces = 0, .ambient = false, .subsurface = false, .specular = false};

optics::Light sun(const cv::Vec3d& towards, double strength = 1)
{
    return {.kind = optics::LightKind::Directional,
            .direction = cv::normalize(towards),
            .strength = {strength, strength, strength}};
}

head::Model ball(const glm::vec4& color, float radius = .1f)
{
    head::Model model;
    model.materials = {scenes::plain("skin", color)};
    scenes::add_ball(model, {0, 0, 0}, radius);
    return model;
}

TEST(PathTracer, LambertBallIsTheCosine)
{
    scene::LoadedScene scene = scenes::scene_of(ball(grey), .8);
    const glm::dvec3 towards = glm::normalize(glm::dvec3(1, 2, 2));
    scene.lights = {sun({1, 2, 2}, 3)};
    const Tracer tracer(scene, direct);
    for (double x = -.09; x < .095; x += .02)
        for (double y = -.09; y < .095; y += .02) {
            const double z2 = .01 - x * x - y * y;
            if (z2 < .0005)
                continue;
            const glm::dvec3 normal = glm::dvec3(x, y, std::sqrt(z2)) / .1;
            const double expected = .5 * .8 * 3 * std::max(0.0, glm::dot(normal, towards));
            const auto seen = tracer.along({x, y, 1}, {0, 0, -1}, 1);
            EXPECT_NEAR(seen.light[1], expected, .004) << x << ", " << y;
            EXPECT_EQ(seen.alpha, 1);
        }
    EXPECT_EQ(tracer.along({.2, 0, 1}, {0, 0, -1}, 1).alpha, 0);
}

// Convex, and no light is lost: as bright as its surroundings, everywhere and in every sample.
TEST(PathTracer, WhiteBallInAWhiteFurnaceCannotBeSeen)
{
    scene::LoadedScene scene = scenes::scene_of(ball(white));
    scene.scene.shading.ambient = {1, 1, 1};
    const Tracer tracer(scene, {.subsurface = false});
    for (const double x : {0.0, .03, .06, .09, .099})
        EXPECT_NEAR(tracer.along({x, .01, 1}, {0, 0, -1}, 200).light[0], 1, .005) << x;
}

// The nose and the cheek beside it light each other: nothing is lost either.
TEST(PathTracer, WhiteHeadInAWhiteFurnaceLosesNoLightBetweenItsParts)
{
    head::Model model = small::head();
    model.materials[0].base_color = cv::Mat4b();
    scene::LoadedScene scene = scenes::scene_of(std::move(model));
    scene.scene.shading.ambient = {1, 1, 1};
    scene.scene.shading.normal_map = false;
    const Tracer tracer(scene, {.subsurface = false});
    for (const double x : {0.0, .01, .015, .02, .04})
        EXPECT_NEAR(tracer.along({x, -.01, 1}, {0, 0, -1}, 400).light[0], 1, .005) << x;
}

// Under the skin light spreads, but a ball that is large against that, in even light, has its albedo.
TEST(PathTracer, SubsurfaceScatteringKeepsTheAlbedo)
{
    scene::LoadedScene scene = scenes::scene_of(ball({.8f, .5f, .2f, 1}), .9);
    scene.scene.shading.ambient = {1, 1, 1};
    for (const double index : {1.0, 1.4}) {
        const Tracer tracer(scene, {.medium = {.anisotropy = 0, .index = index}});
        const auto seen = tracer.along({.02, .01, 1}, {0, 0, -1}, 20'000);
        EXPECT_NEAR(seen.light[0], .72, .01) << "index " << index;
        EXPECT_NEAR(seen.light[1], .45, .01) << "index " << index;
        EXPECT_NEAR(seen.light[2], .18, .01) << "index " << index;
    }
}

// A ball of radius r at the height d above a point takes (r/d)^2 of what the sky sends there.
TEST(PathTracer, ABallTakesItsShareOfTheSky)
{
    head::Model model = small::wall(glm::vec3(1));
    model.materials.push_back(scenes::plain("other", {0, 0, 0, 1}));
    scenes::add_ball(model, {0, 0, .05f}, .03f, 1);
    scene::LoadedScene scene = scenes::scene_of(std::move(model));
    scene.scene.shading.ambient = {1, 1, 1};
    const Tracer tracer(scene, {.bounces = 0, .subsurface = false});
    const auto seen = tracer.along({.1, 0, .01}, {-.1, 0, -.01}, 40'000); // from the side, beneath the ball
    EXPECT_NEAR(seen.light[1], 1 - .36, .01);
}

// The same ball, white: what it sends down again makes up for some of what it takes.
TEST(PathTracer, LightBouncesFromOneToTheOther)
{
    head::Model model = small::wall(glm::vec3(.5f));
    model.materials.push_back(scenes::plain("other", white));
    scenes::add_ball(model, {0, 0, .05f}, .03f, 1);
    scene::LoadedScene scene = scenes::scene_of(std::move(model));
    scene.scene.shading.ambient = {1, 1, 1};
    double before = 0;
    for (const int bounces : {0, 1, 8}) {
        const Tracer tracer(scene, {.bounces = bounces, .subsurface = false});
        const double light = tracer.along({.1, 0, .01}, {-.1, 0, -.01}, 10'000).light[1];
        EXPECT_GT(light, before + .01) << bounces << " bounces";
        EXPECT_LT(light, .5);
        before = light;
    }
}

TEST(PathTracer, EveryLightCastsAShadowAndPointsFallOff)
{
    head::Model model = small::wall(glm::vec3(.5f));
    model.materials.push_back(scenes::plain("other", grey));
    scenes::add_ball(model, {0, 0, .05f}, .02f, 1);
    scene::LoadedScene scene = scenes::scene_of(std::move(model));
    const optics::Light above{
        .kind = optics::LightKind::Point, .position = {0, 0, .5}, .reference_distance_m = 1};
    optics::Light beside = above, even = above;
    beside.position = {.25, 0, .5};
    even.kind = optics::LightKind::PointWithoutFalloff;
    even.position = {-.25, 0, .5};
    const auto lit = [&](const optics::Light& light, const glm::dvec3& at, const Levels& levels) {
        scene.lights = {light};
        return Tracer(scene, levels).along(at + glm::dvec3(.05, 0, .01), {-.05, 0, -.01}, 1).light[1];
    };
    Levels unshadowed = direct;
    unshadowed.shadows = false;
    EXPECT_NEAR(lit(above, {0, 0, 0}, unshadowed), .5 * 4, 1e-6); // half the reference distance
    EXPECT_EQ(lit(above, {0, 0, 0}, direct), 0);
    const double oblique = .5 / std::hypot(.25, .5);
    EXPECT_NEAR(lit(beside, {0, 0, 0}, direct), .5 * oblique / (.25 * .25 + .25), 1e-6); // passes the ball
    EXPECT_NEAR(lit(even, {0, 0, 0}, direct), .5 * oblique, 1e-6);
    EXPECT_EQ(lit(beside, {-.0277, 0, 0}, direct), 0); // its shadow lies there
    scene.scene.shading.shadow = false;
    EXPECT_GT(lit(beside, {-.0277, 0, 0}, direct), 0);
}

TEST(PathTracer, LashesAreSeenThroughByTheirAlphaAndCastNoShadow)
{
    head::Model model = small::wall(glm::vec3(.5f));
    model.materials.push_back(scenes::plain("lashes", {.1f, .1f, .1f, .25f}));
    model.materials.back().alpha = head::AlphaMode::Blend;
    model.materials.back().double_sided = true;
    scenes::add_card(model, {0, 0, .01f}, .02f, 1);
    scene::LoadedScene scene = scenes::scene_of(std::move(model));
    scene.lights = {sun({0, 0, 1})};
    const Tracer tracer(scene, direct);
    EXPECT_NEAR(tracer.along({0, 0, 1}, {0, 0, -1}, 20'000).light[1], .25 * .1 + .75 * .5, .004);
    EXPECT_EQ(tracer.along({.015, 0, .009}, {-.015, 0, -.009}, 1).light[1], .5); // beneath the card
}

TEST(PathTracer, BacksOfOneSidedSurfacesAreLookedThrough)
{
    head::Model model = small::wall(glm::vec3(.5f));
    scene::LoadedScene scene = scenes::scene_of(model);
    scene.lights = {sun({0, 0, -1})};
    EXPECT_EQ(Tracer(scene, direct).along({0, 0, -1}, {0, 0, 1}, 1).alpha, 0);
    model.materials[0].double_sided = true;
    scene::LoadedScene both = scenes::scene_of(model);
    both.lights = scene.lights;
    EXPECT_NEAR(Tracer(both, direct).along({0, 0, -1}, {0, 0, 1}, 1).light[1], .5, 1e-9);
}

// The lobe is that of wound/optics, with its own shadow.
TEST(PathTracer, HighlightIsThatOfTheOptics)
{
    scene::LoadedScene scene = scenes::scene_of(small::wall(glm::vec3(.5f)), .7);
    scene.lights = {{.kind = optics::LightKind::Point,
                     .position = {.2, .1, .4},
                     .strength = {2, 1, .5},
                     .reference_distance_m = .5}};
    optics::Shading& shading = scene.scene.shading;
    shading.translucency = false;
    shading.rho_ts = 0;
    shading.alpha_x = .2;
    const glm::dvec3 eye(-.2, 0, .4);
    for (const auto& [model, ward] : {std::pair(optics::SpecularModel::Ward, optics::WardModel::Published),
                                      {optics::SpecularModel::Ward, optics::WardModel::Bounded},
                                      {optics::SpecularModel::Skin, optics::WardModel::Duer},
                                      {optics::SpecularModel::Skin, optics::WardModel::Bounded}}) {
        shading.specular_model = model;
        shading.ward_model = ward;
        Levels levels = direct;
        levels.specular = true;
        const auto seen = Tracer(scene, levels).along(eye, -eye, 1);
        const glm::dvec3 viewer = glm::normalize(eye);
        const base::Color expected = optics::shade(
            shading, scene.lights[0],
            {.position = {0, 0, 0}, .to_viewer = {viewer.x, viewer.y, viewer.z}, .albedo = {.5, .5, .5}}, 1);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen.light[c], expected[c], 1e-6);
    }
}

// Even light is mirrored as much as the lobes reflect; a black ball above takes its share of it.
TEST(PathTracer, SurroundingsAreMirrored)
{
    head::Model model = small::wall(glm::vec3(.5f));
    const glm::dvec3 eye(.3, 0, .1);
    const auto seen = [&](const head::Model& of) {
        scene::LoadedScene scene = scenes::scene_of(of, 0); // nothing but the highlight
        scene.scene.shading.specular_model = optics::SpecularModel::Skin;
        scene.scene.shading.ambient = {1, .5, 0};
        return Tracer(scene, {.subsurface = false}).along(eye, -eye, 40'000).light;
    };
    const glm::dvec3 viewer = glm::normalize(eye);
    const double albedo = optics::specular_albedo(optics::skin_shading(), {}, {viewer.x, viewer.y, viewer.z});
    const base::Color open = seen(model);
    EXPECT_NEAR(open[0], albedo, .02 * albedo);
    EXPECT_NEAR(open[1], albedo / 2, .02 * albedo);
    EXPECT_EQ(open[2], 0);
    model.materials.push_back(scenes::plain("other", {0, 0, 0, 1}));
    scenes::add_ball(model, {-.06f, 0, .03f}, .025f, 1);
    EXPECT_LT(seen(model)[0], .7 * albedo);
}

} // namespace
