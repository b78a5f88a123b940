// The shadow map against traced rays: no light past the edge of a shadow, no shadow where there is none.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "head/vectors.hpp"
#include "reference/surface.hpp"
#include "reference/wounds.hpp"
#include "stage/renderer.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"

namespace {

constexpr int side = 128, lights = 100;

cv::Mat4f drawn_radiance(stage::Renderer& renderer, const scene::Scene& scene)
{
    const stage::Stage stage(renderer.device, stage::Stage::prepare(scene));
    stage::DrawOptions drawing;
    drawing.size = scene.size;
    drawing.transparent = drawing.radiance = true;
    return stage::draw(renderer, stage, {.camera = stage.loaded().camera()}, drawing).radiance;
}

/// A head lit by lights alone, of one white diffuse surface.
scene::Scene lambert_scene()
{
    scene::Scene scene = small::scene(small::head(), side);
    scene.wounds.clear();
    scene.shading.transport = optics::Transport::Preintegrated; // whose shadow map follows the camera
    scene.shading.translucency = scene.shading.ward = scene.shading.normal_map = false;
    scene.shading.ambient = {0, 0, 0};
    return scene;
}

/// What the map says, 0..1, where light falls; -1 where none would fall without a shadow.
cv::Mat1f drawn_visibility(stage::Renderer& renderer, const scene::Scene& scene)
{
    std::array<cv::Mat4f, 2> light;
    for (const bool shadow : {false, true}) {
        scene::Scene one = scene;
        one.shading.shadow = shadow;
        light[shadow] = drawn_radiance(renderer, one);
    }
    cv::Mat1f visibility(side, side, -1.f);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            if (light[0](y, x)[3] == 1 && light[0](y, x)[1] > .02f)
                visibility(y, x) = light[1](y, x)[1] / light[0](y, x)[1];
    return visibility;
}

struct Wrong
{
    int lit = 0;    // pixels on which light falls
    int leaks = 0;  // lit by the map, in shadow by rays
    int shadow = 0; // the other way
};

Wrong compared(const cv::Mat1f& drawn, const scene::LoadedScene& scene)
{
    const reference::DayWounds wounds(scene, 0, std::nullopt);
    const reference::Surfaces surfaces(scene, wounds);
    const head::Camera camera = scene.camera();
    Wrong wrong;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::dvec3 sight = head::sight_through_pixel(camera, {x + .5, y + .5}, {side, side});
            const auto hit = surfaces.seen(camera.eye, glm::normalize(sight), 0);
            if (!hit || drawn(y, x) < 0)
                continue;
            const reference::SurfacePoint point = surfaces.point(*hit);
            const optics::Light& light = scene.lights[0];
            const bool blocked =
                !surfaces.reached_by(light, optics::sample_light(light, head::to_cv(point.at)), point);
            wrong.lit += !blocked;
            wrong.leaks += blocked && drawn(y, x) > .9f;
            wrong.shadow += !blocked && drawn(y, x) < .1f;
        }
    return wrong;
}

} // namespace

TEST(ShadowTruth, AgreesWithRaysForAHundredLights)
{
    stage::Renderer renderer({.validation = true});
    scene::Scene scene = lambert_scene();
    Wrong all;
    for (int i = 0; i < lights; ++i) {
        scene::Light light;
        light.from = {std::fmod(i * 137.508, 360) - 180, -80 + 160. * i / (lights - 1)};
        light.distance_m = .9;
        scene.lights = {light};
        const Wrong wrong = compared(drawn_visibility(renderer, scene), scene::load(scene));
        EXPECT_LE(wrong.leaks, 2 + .01 * wrong.lit) << i;
        EXPECT_LE(wrong.shadow, 2 + .01 * wrong.lit) << i;
        all.lit += wrong.lit;
        all.leaks += wrong.leaks;
        all.shadow += wrong.shadow;
    }
    EXPECT_GT(all.lit, 100 * side);
    EXPECT_LE(all.leaks, .002 * all.lit);
    EXPECT_LE(all.shadow, .002 * all.lit);
    fmt::print("{} lit pixels: {} leaks, {} false shadows\n", all.lit, all.leaks, all.shadow);
    stage::fail_on_validation(renderer.device);
}

// Light adds up: three lights together are the sum of each alone, shadows included.
TEST(ShadowTruth, EveryLightCastsItsOwnShadow)
{
    stage::Renderer renderer({.validation = true});
    scene::Scene scene = lambert_scene();
    scene::Light left, right, above, off;
    left.from = {-45, 20};
    right.from = {50, 10};
    above.from = {0, 60};
    off.intensity = 0;
    for (scene::Light* light : {&left, &right, &above})
        light->distance_m = .9;
    cv::Mat4f sum(side, side, cv::Vec4f::all(0));
    for (const scene::Light& light : {left, right, above}) {
        scene.lights = {light};
        sum += drawn_radiance(renderer, scene);
    }
    scene.lights = {left, off, right, above};
    const cv::Mat4f together = drawn_radiance(renderer, scene);
    scene.shading.shadow = false;
    const cv::Mat4f unshadowed = drawn_radiance(renderer, scene);
    int wrong = 0, shadowed = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            wrong += std::abs(together(y, x)[1] - sum(y, x)[1]) > .01f + .01f * sum(y, x)[1];
            shadowed += unshadowed(y, x)[1] - together(y, x)[1] > .02f;
        }
    EXPECT_GT(shadowed, 50);
    EXPECT_LT(wrong, 40); // at edges: from the third light on its place in the map is not interpolated
    stage::fail_on_validation(renderer.device);
}
