#include "passes/shadow.hpp"

#include <gtest/gtest.h>

namespace {

const glm::vec3 head_min(-0.09f, -0.14f, -0.11f), head_max(0.09f, 0.12f, 0.12f);

optics::Light point_light(double x, double y, double z)
{
    optics::Light light;
    light.position = {x, y, z};
    return light;
}

optics::Light parallel_light(const cv::Vec3d& towards)
{
    optics::Light light;
    light.kind = optics::LightKind::Directional;
    light.direction = cv::normalize(towards);
    return light;
}

glm::vec3 seen(const shared::Shadow& shadow, const glm::vec3& point)
{
    const glm::vec4 clip = shadow.clip_from_world * glm::vec4(point, 1);
    return glm::vec3(clip) / clip.w;
}

const std::vector<optics::Light> lights = {
    point_light(0.3, 0.4, 0.6), point_light(0, 2, 0),    point_light(0, -1, 0.001),
    point_light(-20, 3, 5),     point_light(0.25, 0, 0), parallel_light({0.3, 0.5, 0.8}),
    parallel_light({0, 1, 0}),
};

} // namespace

TEST(Shadow, FrustumEnclosesTheBoxTightly)
{
    for (const optics::Light& light : lights) {
        const auto shadow = passes::fit_shadow(light, head_min, head_max);
        ASSERT_TRUE(shadow);
        float widest = 0;
        for (int i = 0; i < 8; ++i) {
            const glm::vec3 corner(i & 1 ? head_max.x : head_min.x, i & 2 ? head_max.y : head_min.y,
                                   i & 4 ? head_max.z : head_min.z);
            const glm::vec3 p = seen(*shadow, corner);
            EXPECT_TRUE(std::abs(p.x) < 1 && std::abs(p.y) < 1 && p.z > 0 && p.z < 1)
                << p.x << ' ' << p.y << ' ' << p.z;
            widest = std::max({widest, std::abs(p.x), std::abs(p.y)});
        }
        EXPECT_GT(widest, 0.95f);
    }
}

TEST(Shadow, DepthGrowsAwayFromTheLightAndUpIsUp)
{
    const auto shadow = passes::fit_shadow(point_light(0, 0, 1), head_min, head_max);
    ASSERT_TRUE(shadow);
    EXPECT_LT(seen(*shadow, {0, 0, 0.1f}).z, seen(*shadow, {0, 0, -0.1f}).z);
    EXPECT_LT(seen(*shadow, {0, 0.1f, 0}).y, 0); // Vulkan's y points down
    EXPECT_GT(seen(*shadow, {0.05f, 0, 0}).x, 0);
}

TEST(Shadow, TexelIsItsWidthInMetres)
{
    for (const optics::Light& light : {point_light(0, 0, 0.7), parallel_light({0, 0, 1})}) {
        const auto shadow = passes::fit_shadow(light, head_min, head_max);
        ASSERT_TRUE(shadow);
        const glm::vec4 clip = shadow->clip_from_world * glm::vec4(0, 0, 0.1f, 1);
        const float width = shadow->texel * clip.w;
        const float step = seen(*shadow, {width, 0, 0.1f}).x - seen(*shadow, {0, 0, 0.1f}).x;
        EXPECT_NEAR(step * passes::shadow_size / 2, 1, 1e-3); // clip space is 2 wide
    }
}

TEST(Shadow, IsNarrowedToWhatIsSeenAndKeepsAllCastersBeforeIt)
{
    const passes::Bounds face{{-.05f, -.05f, 0}, {.05f, .05f, .12f}};
    for (const optics::Light& light : lights) {
        const auto whole = passes::fit_shadow(light, head_min, head_max),
                   narrow = passes::fit_shadow(light, head_min, head_max, {&face, 1});
        ASSERT_TRUE(narrow);
        EXPECT_LT(narrow->texel, .85f * whole->texel);
        EXPECT_GE(narrow->texel, .249f * whole->texel);
        for (int i = 0; i < 8; ++i) {
            const auto corner_of = [&](const glm::vec3& min, const glm::vec3& max) {
                return glm::vec3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
            };
            const glm::vec3 p = seen(*narrow, corner_of(face.min, face.max));
            EXPECT_TRUE(std::abs(p.x) < 1 && std::abs(p.y) < 1) << p.x << ' ' << p.y;
            const float depth = seen(*narrow, corner_of(head_min, head_max)).z;
            EXPECT_TRUE(depth > 0 && depth < 1) << depth;
        }
    }
}

// A texel must keep its place on the head, or shadows crawl.
TEST(Shadow, StaysWhileTheCameraMovesALittleAndThenMovesByWholeTexels)
{
    for (const optics::Light& light : {point_light(0.3, 0.4, 0.6), parallel_light({0.3, 0.5, 0.8})}) {
        std::vector<shared::Shadow> fitted;
        for (int i = 0; i < 200; ++i) {
            const glm::vec3 low(-.08f + 2e-4f * float(i), -.03f, .05f);
            const passes::Bounds face{low, low + glm::vec3(.08f, .08f, .01f)};
            fitted.push_back(*passes::fit_shadow(light, head_min, head_max, {&face, 1}));
        }
        int changes = 0, moves = 0;
        for (std::size_t i = 1; i < fitted.size(); ++i) {
            if (fitted[i].clip_from_world == fitted[i - 1].clip_from_world)
                continue;
            ++changes;
            if (fitted[i].texel != fitted[i - 1].texel)
                continue;
            ++moves;
            const glm::vec2 texels =
                glm::vec2(seen(fitted[i], {0, 0, .05f}) - seen(fitted[i - 1], {0, 0, .05f})) *
                (.5f * passes::shadow_size);
            EXPECT_LT(glm::length(texels - glm::round(texels)), .02f);
            EXPECT_GE(glm::length(texels), 127);
        }
        EXPECT_LE(changes, 20);
        EXPECT_GE(moves, 2);
    }
}

TEST(Shadow, LightInsideTheHeadCastsNoShadow)
{
    EXPECT_FALSE(passes::fit_shadow(point_light(0, 0, 0), head_min, head_max));
    EXPECT_FALSE(passes::fit_shadow(point_light(0.1, 0, 0), head_min, head_max));
}

TEST(Shadow, EmptyBoxCastsNoShadow)
{
    EXPECT_FALSE(passes::fit_shadow(point_light(0, 0, 1), {}, {}));
}
