#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/gpu/mesh_buffer.hpp"
#include "passes/head.hpp"
#include "passes/shadow.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/layout.hpp"

namespace {

struct Receiver
{
    glm::vec3 position, normal, to_light;
    float curvature = 0; // 1/m, of the body that light enters
};

struct Scene
{
    std::vector<head::Vertex> vertices;
    std::vector<std::uint32_t> indices;
    glm::vec3 min{-0.1f}, max{0.1f};

    void quad(const glm::vec3& center, const glm::vec3& right, const glm::vec3& up)
    {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        for (const glm::vec2 c : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
            vertices.push_back(
                {center + c.x * right + c.y * up, glm::normalize(glm::cross(right, up)), {}, {}});
        for (std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
            indices.push_back(first + i);
    }
    void ball(float radius)
    {
        constexpr std::uint32_t rings = 48, sectors = 96;
        for (std::uint32_t j = 0; j <= rings; ++j)
            for (std::uint32_t k = 0; k <= sectors; ++k) {
                const double theta = std::numbers::pi * j / rings, phi = 2 * std::numbers::pi * k / sectors;
                const glm::vec3 n(glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                             std::sin(theta) * std::sin(phi)));
                vertices.push_back({radius * n, n, {}, {}});
            }
        for (std::uint32_t j = 0; j < rings; ++j)
            for (std::uint32_t k = 0; k < sectors; ++k) {
                const std::uint32_t a = j * (sectors + 1) + k, b = a + sectors + 1;
                for (std::uint32_t i : {a, a + 1, b, b, a + 1, b + 1})
                    indices.push_back(i);
            }
    }
};

optics::Light light_at(const glm::vec3& position)
{
    optics::Light light;
    light.position = {position.x, position.y, position.z};
    return light;
}

// One frame: the shadow's depth and, when there are receivers, their visibility.
struct Frame
{
    gpu::FrameResult result;
    std::vector<float> visibility, through_m;
};

Frame render(gpu::Executor& executor, const Scene& scene, const gpu::MeshBuffer& mesh,
             const optics::Light& light, std::vector<Receiver> receivers)
{
    const glm::vec3 position(glm::dvec3(light.position[0], light.position[1], light.position[2]));
    for (Receiver& r : receivers)
        r.to_light = glm::normalize(position - r.position);
    const auto shadow = passes::fit_shadow(light, scene.min, scene.max);
    if (!shadow)
        throw std::logic_error("the light casts no shadow");

    const head::Primitive whole{0, static_cast<std::uint32_t>(scene.indices.size()), 0};
    graph::Graph graph;
    passes::Shadows alone{.casting = 1};
    alone.lights[0] = *shadow;
    const graph::ImageId depth = passes::add_shadows(graph, "shadow", alone, mesh, std::span(&whole, 1));
    if (receivers.empty())
        return {executor.run(graph), {}, {}};

    const auto count = static_cast<std::uint32_t>(receivers.size());
    const graph::ImageId results = graph.image("results", {count, 2, VK_FORMAT_R32_SFLOAT});
    graph::ComputePass& pass = graph.compute("receive", "shadow_test.comp");
    pass.buffer<Receiver>("ReceiverBlock", receivers);
    pass.uniform("ShadowBlock", *shadow);
    pass.sample("shadow_depth", depth, graph::Sampler::NearestClamp);
    pass.store("results", results);
    pass.dispatch(count, 2);
    const graph::ReadbackId back = graph.readback("results", results);
    gpu::FrameResult result = executor.run(graph);
    const cv::Mat1f values = result.mat(back);
    const std::vector<float> lit(values.begin(), values.begin() + values.cols),
        through(values.begin() + values.cols, values.end());
    return {std::move(result), lit, through};
}

Frame rendered(const Scene& scene, const optics::Light& light, const std::vector<Receiver>& receivers)
{
    const gpu::MeshBuffer mesh =
        passes::upload_mesh(gpu_test::device(), scene.vertices, scene.indices, "scene");
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    return render(executor, scene, mesh, light, receivers);
}

std::vector<float> visibilities(const Scene& scene, const optics::Light& light,
                                const std::vector<Receiver>& receivers)
{
    return rendered(scene, light, receivers).visibility;
}

Scene floor_under_a_plate()
{
    Scene scene;
    scene.quad({0, 0, -0.05f}, {0.1f, 0, 0}, {0, 0.1f, 0});
    scene.quad({0, 0, 0.05f}, {0.02f, 0, 0}, {0, 0.02f, 0});
    return scene;
}

using ShadowOnGpu = gpu_test::Test;

} // namespace

TEST_F(ShadowOnGpu, PlateShadowsTheFloorExactlyWhereGeometryPredicts)
{
    // Light .5 above the plate, floor .1 below: the shadow is 1.2 times the plate, with half width .024.
    const Scene scene = floor_under_a_plate();
    std::vector<Receiver> receivers;
    for (float x = -0.098f; x < 0.098f; x += 0.00049f)
        receivers.push_back({{x, 0.003f, -0.05f}, {0, 0, 1}, {}});
    const std::vector<float> lit = visibilities(scene, light_at({0, 0, 0.55f}), receivers);
    for (std::size_t n = 0; n < lit.size(); ++n) {
        const float x = std::abs(receivers[n].position.x);
        if (x < 0.022f) {
            EXPECT_EQ(lit[n], 0) << x;
        }
        if (x > 0.026f) {
            EXPECT_EQ(lit[n], 1) << x;
        }
    }
}

TEST_F(ShadowOnGpu, EdgesAreStraightRampsThreeTexelsWide)
{
    const Scene scene = floor_under_a_plate();
    const optics::Light light = light_at({0, 0, 0.55f});
    const float texel = passes::fit_shadow(light, scene.min, scene.max)->texel * 0.6f; // on the floor
    const float step = texel / 10;
    for (const glm::vec3& outward :
         {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)})
    {
        std::vector<Receiver> receivers;
        for (float x = 0.02f; x < 0.028f; x += step)
            receivers.push_back(
                {glm::vec3(0.0031f, 0.0031f, -0.05f) * (1.0f - glm::abs(outward)) + x * outward,
                 {0, 0, 1},
                 {}});
        const std::vector<float> lit = visibilities(scene, light, receivers);
        int on_the_ramp = 0;
        for (std::size_t n = 1; n < lit.size(); ++n)
            if (lit[n - 1] > 0.01f && lit[n] < 0.99f) {
                EXPECT_NEAR(lit[n] - lit[n - 1], 1.0f / 30, 2e-3) << n;
                ++on_the_ramp;
            }
        EXPECT_NEAR(on_the_ramp, 29, 2);
    }
}

TEST_F(ShadowOnGpu, NoSurfaceShadowsItself)
{
    Scene ball;
    ball.ball(0.1f);
    std::vector<Receiver> receivers;
    const glm::vec3 light(0.2f, 0.4f, 0.5f);
    for (std::size_t n = 0; n < ball.vertices.size(); ++n) {
        const head::Vertex& v = ball.vertices[n];
        if (glm::dot(v.normal, glm::normalize(light - v.position)) > 0.1f)
            receivers.push_back({v.position, v.normal, {}});
    }
    ASSERT_GT(receivers.size(), 1000u);
    for (float lit : visibilities(ball, light_at(light), receivers))
        EXPECT_EQ(lit, 1);
}

TEST_F(ShadowOnGpu, FarSideOfABallIsDark)
{
    Scene ball;
    ball.ball(0.1f);
    std::vector<Receiver> receivers;
    const glm::vec3 light(0.2f, 0.4f, 0.5f);
    for (const head::Vertex& v : ball.vertices)
        if (glm::dot(v.normal, glm::normalize(light - v.position)) <
            -0.3f) // just past the terminator Lambert is 0 anyway
            receivers.push_back({v.position, v.normal, {}});
    ASSERT_GT(receivers.size(), 1000u);
    for (float lit : visibilities(ball, light_at(light), receivers))
        EXPECT_EQ(lit, 0);
}

TEST_F(ShadowOnGpu, AnEarIsAsThickAsGeometrySays)
{
    Scene scene; // two sheets 4 mm apart, lit from the front
    scene.quad({0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0});
    scene.quad({0, 0, -0.004f}, {-0.1f, 0, 0}, {0, 0.1f, 0});
    const glm::vec3 light(0.1f, 0.2f, 0.5f);
    std::vector<Receiver> receivers;
    for (float x = -0.08f; x < 0.08f; x += 0.0071f)
        receivers.push_back({{x, 0.3f * x, -0.004f}, {0, 0, -1}, {}, 50});
    const std::vector<float> through = rendered(scene, light_at(light), receivers).through_m;
    for (std::size_t n = 0; n < through.size(); ++n) {
        const glm::vec3 to_light = glm::normalize(light - receivers[n].position);
        EXPECT_NEAR(through[n], 0.004f / to_light.z, 1.5e-4f) << receivers[n].position.x;
    }
}

// Light that spreads under the skin goes round the terminator: the ball's far side is reached a little way, and not
// where another body is in the way.
TEST_F(ShadowOnGpu, ABodyDoesNotShadowItsOwnTerminator)
{
    Scene ball;
    ball.ball(0.02f);
    const glm::vec3 light(0, 0, 0.5f);
    std::vector<Receiver> receivers;
    for (const float behind : {0.02f, 0.05f, 0.1f, 0.2f}) {
        const glm::vec3 n(std::sqrt(1 - behind * behind), 0, -behind);
        receivers.push_back({0.02f * n, n, {}, 50});
    }
    for (float lit : visibilities(ball, light_at(light), receivers))
        EXPECT_GT(lit, 0.9f);
    Scene blocked = ball;
    blocked.quad({0, 0, 0.08f}, {0.05f, 0, 0}, {0, 0.05f, 0});
    for (float lit : visibilities(blocked, light_at(light), receivers))
        EXPECT_EQ(lit, 0);
}

TEST_F(ShadowOnGpu, EverythingOutsideTheShadowMapIsLit)
{
    const Scene scene = floor_under_a_plate();
    for (float lit : visibilities(
             scene, light_at({0, 0, 0.55f}),
             {{{5, 0, 0}, {0, 0, 1}, {}}, {{0, 0, 0.6f}, {0, 0, 1}, {}}, {{0, 0, 0.55f}, {0, 0, 1}, {}}}))
        EXPECT_EQ(lit, 1);
}

TEST_F(ShadowOnGpu, RunsOnlyWhenTheLightMovesAndAReceiverExists)
{
    const Scene scene = floor_under_a_plate();
    const gpu::MeshBuffer mesh =
        passes::upload_mesh(gpu_test::device(), scene.vertices, scene.indices, "scene");
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const auto state = [&](const optics::Light& light, const std::vector<Receiver>& receivers) {
        return render(executor, scene, mesh, light, receivers).result.pass("shadow").state;
    };
    const Receiver here{{0, 0, -0.05f}, {0, 0, 1}, {}}, there{{0.08f, 0, -0.05f}, {0, 0, 1}, {}};
    EXPECT_EQ(state(light_at({0, 0, 0.55f}), {here}), graph::PassState::Run);
    EXPECT_EQ(state(light_at({0, 0, 0.55f}), {there}), graph::PassState::Skipped);
    EXPECT_EQ(state(light_at({0.1f, 0, 0.55f}), {there}), graph::PassState::Run);
    EXPECT_EQ(state(light_at({0.1f, 0, 0.55f}), {}), graph::PassState::Culled);
}

TEST_F(ShadowOnGpu, SharedStructHasTheSameLayoutInBothLanguages)
{
    gpu_test::expect_layout("shadow_test.comp", "Shadow", sizeof(shared::Shadow),
                            {CICATRIX_MEMBER(shared::Shadow, clip_from_world),
                             CICATRIX_MEMBER(shared::Shadow, clip_plane_from_world),
                             CICATRIX_MEMBER(shared::Shadow, texel), CICATRIX_MEMBER(shared::Shadow, step)});
}
