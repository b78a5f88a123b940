#include "passes/in_view.hpp"

#include <gtest/gtest.h>
#include <random>

#include "passes/forward.hpp"
#include "tests/support/small_head.hpp"

namespace {

constexpr std::array<std::uint32_t, 2> size{200, 100};

/// From 1 m in front of the middle of a head whose bounds are +-.2 m; shows 22 cm of it in height.
glm::mat4 view(const glm::dvec3& eye = {0, 0, 1})
{
    passes::Head head;
    head.min = glm::vec3(-.2f);
    head.max = glm::vec3(.2f);
    return passes::make_view({eye, {0, 0, 0}, 12.5}, head, passes::ViewportTile(size)).clip_from_world;
}

/// A triangle of a centimetre that faces +z.
passes::Triangle facing(const glm::vec3& at)
{
    return {{at, at + glm::vec3(.01f, 0, 0), at + glm::vec3(0, .01f, 0)}};
}

passes::Triangle turned(passes::Triangle triangle)
{
    std::swap(triangle.corners[1], triangle.corners[2]);
    return triangle;
}

bool shown(const passes::Triangle& triangle, const glm::dvec3& eye = {0, 0, 1})
{
    return passes::may_show({&triangle, 1}, view(eye), size);
}

} // namespace

TEST(InView, ATriangleIsShownWhenItFacesTheCameraInsideThePicture)
{
    EXPECT_TRUE(shown(facing({0, 0, 0})));
    EXPECT_FALSE(shown(turned(facing({0, 0, 0}))));
    EXPECT_FALSE(shown(facing({0, 0, 0}), {0, 0, -1}));
    passes::Triangle sheet = turned(facing({0, 0, 0}));
    sheet.double_sided = true;
    EXPECT_TRUE(shown(sheet));
    for (const glm::vec3& out : {glm::vec3(.3f, 0, 0), glm::vec3(-.3f, 0, 0), glm::vec3(0, .15f, 0),
                                 glm::vec3(0, -.15f, 0), glm::vec3(0, 0, 1.2f)})
        EXPECT_FALSE(shown(facing(out))) << out.x << ' ' << out.y << ' ' << out.z;
    const std::array both{facing({.3f, 0, 0}), facing({0, 0, 0})};
    EXPECT_TRUE(passes::may_show(both, view(), size));
    EXPECT_FALSE(passes::may_show({}, view(), size));
}

// Seen from the edge, a device's rounding may turn the triangle to the camera.
TEST(InView, ATriangleSeenFromTheEdgeIsKept)
{
    EXPECT_TRUE(shown({{glm::vec3(0), glm::vec3(.01f, 0, 0), glm::vec3(0, 1e-9f, .01f)}}));
    EXPECT_TRUE(shown({{glm::vec3(0), glm::vec3(.01f, 0, 0), glm::vec3(0, -1e-9f, .01f)}}));
}

TEST(InView, ATriangleThatReachesBehindTheCameraIsKept)
{
    EXPECT_TRUE(shown({{glm::vec3(0, -.05f, 0), glm::vec3(.1f, -.05f, 2), glm::vec3(-.1f, -.05f, 2)}}));
}

TEST(InView, BoxesHoldEveryTriangle)
{
    const head::Model model = small::head();
    const std::vector<passes::Bounds> boxes = passes::boxes_around(model);
    EXPECT_GT(boxes.size(), 100u);
    EXPECT_LT(boxes.size(), 3000u);
    for (std::size_t i = 0; i < model.indices.size(); i += 3) {
        const auto corners = head::corners_of(model, i);
        EXPECT_TRUE(std::ranges::any_of(boxes, [&](const passes::Bounds& box) {
            return std::ranges::all_of(corners, [&](const glm::vec3& corner) {
                return glm::all(glm::lessThanEqual(box.min, corner)) &&
                       glm::all(glm::lessThanEqual(corner, box.max));
            });
        })) << i;
    }
}

TEST(InView, BoxesInViewAreThoseThatReachIntoThePicture)
{
    std::vector<passes::Bounds> boxes;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-.2f, .2f);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 low(place(random), place(random), place(random));
        boxes.push_back({low, low + .02f});
    }
    const std::vector<passes::Bounds> seen = passes::boxes_in_view(boxes, view());
    EXPECT_GT(seen.size(), 30u);
    EXPECT_LT(seen.size(), 290u);
    for (const passes::Bounds& box : boxes) {
        const glm::vec4 clip = view() * glm::vec4(.5f * (box.min + box.max), 1);
        if (std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w) {
            EXPECT_TRUE(std::ranges::any_of(seen, [&](const passes::Bounds& b) { return b.min == box.min; }));
        }
    }
    EXPECT_TRUE(passes::boxes_in_view(boxes, view({0, 0, -5}) * glm::mat4(-1)).empty())
        << "behind the camera";
}
