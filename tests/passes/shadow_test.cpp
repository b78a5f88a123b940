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

TEST(Shadow, LightInsideTheHeadCastsNoShadow)
{
    EXPECT_FALSE(passes::fit_shadow(point_light(0, 0, 0), head_min, head_max));
    EXPECT_FALSE(passes::fit_shadow(point_light(0.1, 0, 0), head_min, head_max));
}

TEST(Shadow, EmptyBoxCastsNoShadow)
{
    EXPECT_FALSE(passes::fit_shadow(point_light(0, 0, 1), {}, {}));
}
