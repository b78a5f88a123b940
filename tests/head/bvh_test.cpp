// The hierarchy finds the same hits as brute force over all triangles, bit for bit.
#include "head/bvh.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>
#include <vector>

#include "head/surface.hpp"
#include "tests/support/ray_meshes.hpp"

using namespace ray_meshes;

TEST(Bvh, EqualsBruteForceOnATriangleSoup)
{
    const Mesh mesh = soup(600);
    const Bvh bvh = mesh.bvh();
    Dice dice;
    Comparison comparison;
    for (int i = 0; i < 4000; ++i) {
        const dvec3 origin = dice.in_cube(0.4),
                    at = i % 4 ? dice.in_cube(0.2) : mesh.corner(std::size_t(i) % 1800);
        const Ray ray{origin, std::pow(10, dice.number(-2, 2)) * glm::normalize(at - origin)};
        const double length = glm::length(ray.direction);
        comparison.add(mesh, bvh, ray, i % 2 ? 0 : 0.1 / length, i % 3 ? infinity : 0.3 / length);
    }
    EXPECT_EQ(comparison.different, 0);
    EXPECT_GT(comparison.hits, comparison.rays / 4);
    EXPECT_LT(comparison.hits, comparison.rays);
}

TEST(Bvh, HitsVerticesAndEdgesThatAreAimedAtExactly)
{
    const Mesh mesh = sphere();
    const Bvh bvh = mesh.bvh();
    Dice dice;
    Comparison comparison;
    const auto aim = [&](const dvec3& at) {
        for (const dvec3& eye : {dvec3(0), dvec3(0, 0, 1), 0.5 * dice.on_sphere(), 0.09 * dice.on_sphere()})
            comparison.add(mesh, bvh, {eye, at - eye});
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            aim(mesh.corner(i + k));
            aim(0.5 * (mesh.corner(i + k) + mesh.corner(i + (k + 1) % 3)));
        }
    EXPECT_EQ(comparison.different, 0);
    EXPECT_GT(comparison.rays, 50'000);
}

TEST(Bvh, LetsNoRayOutOfAClosedSphere)
{
    const Mesh mesh = sphere();
    const Bvh bvh = mesh.bvh();
    Dice dice;
    for (int i = 0; i < 20'000; ++i) {
        const dvec3 target = i % 2 ? dice.on_sphere() : mesh.corner(std::size_t(i) % mesh.indices.size());
        const auto hit = bvh.nearest(dice.in_cube(0.05), target, 0, infinity);
        ASSERT_TRUE(hit) << i;
        EXPECT_FALSE(hit->front);
    }
}

TEST(Bvh, IsAsExactForOriginsFarAway)
{
    const Mesh mesh = sphere();
    const Bvh bvh = mesh.bvh();
    Dice dice;
    for (const double away : {10., 1e4, 1e7}) {
        Comparison comparison;
        for (int i = 0; i < 3000; ++i) {
            const dvec3 origin = away * dice.on_sphere();
            const dvec3 at = i % 2 ? dice.in_cube(0.1) : mesh.corner(std::size_t(i) % mesh.indices.size());
            comparison.add(mesh, bvh, {origin, at - origin});
        }
        EXPECT_EQ(comparison.different, 0) << away;
        EXPECT_GT(comparison.hits, comparison.rays / 4) << away;
    }
}

TEST(Bvh, ReturnsWhereInTheTriangleTheHitIs)
{
    Mesh mesh;
    mesh.add({0, 0, 5}, {1, 0, 5}, {0, 1, 5}); // another one, behind
    mesh.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Bvh bvh = mesh.bvh();
    const auto above = bvh.nearest({0.25, 0.5, -3}, {0, 0, 2}, 0, infinity);
    ASSERT_TRUE(above);
    EXPECT_EQ(above->triangle, 3u);
    EXPECT_DOUBLE_EQ(above->distance, 1.5) << "in multiples of the direction's length";
    EXPECT_DOUBLE_EQ(above->u, 0.25);
    EXPECT_DOUBLE_EQ(above->v, 0.5);
    EXPECT_FALSE(above->front);
    EXPECT_FALSE(bvh.nearest({0.25, 0.5, -3}, {0, 0, 2}, 0, infinity, Facing::Front));
    const auto behind = bvh.nearest({0.25, 0.5, 4}, {0, 0, -1}, 0, infinity, Facing::Front);
    ASSERT_TRUE(behind);
    EXPECT_TRUE(behind->front);
    EXPECT_EQ(behind->triangle, 3u);
    EXPECT_TRUE(bvh.any({0.25, 0.5, 4}, {0, 0, -1}, 4)) << "the range includes its end";
    EXPECT_FALSE(bvh.any({0.25, 0.5, 4}, {0, 0, -1}, 3.999));
}

TEST(Bvh, FindsTheFirstOfTrianglesThatAreEquallyNear)
{
    // 40 squares at the same place: their boxes are equal, so the hierarchy may visit them in any order.
    const Mesh mesh = squares(std::vector<float>(40, 0.f));
    const Bvh bvh = mesh.bvh();
    EXPECT_EQ(bvh.nearest({0.003, -0.002, 1}, {0, 0, -1}, 0, infinity)->triangle, 0u);
    EXPECT_EQ(bvh.nearest({-0.003, 0.002, 1}, {0, 0, -1}, 0, infinity)->triangle, 3u);
    EXPECT_EQ(bvh.nearest({0.003, 0.003, 1}, {0, 0, -1}, 0, infinity)->triangle, 0u) << "on the shared edge";
}

TEST(Bvh, ContinuesBehindHitsThatAFilterRejects)
{
    const Mesh mesh = squares({0.1f, 0.4f, 0.2f, 0.3f, 0.0f, 0.2f});
    const Bvh bvh = mesh.bvh();
    const dvec3 eye(0.003, -0.002, 1), down(0, 0, -1); // over the first triangle of each square
    std::vector<std::uint32_t> passed;
    const auto not_passed = [&](const Hit& hit) {
        return std::ranges::find(passed, hit.triangle) == passed.end();
    };
    while (const auto hit = bvh.nearest(eye, down, 0, infinity, Facing::Front, not_passed))
        passed.push_back(hit->triangle);
    EXPECT_EQ(passed, (std::vector<std::uint32_t>{6, 18, 12, 30, 0, 24}));
    EXPECT_FALSE(bvh.any(eye, down, infinity, not_passed));
    passed.pop_back();
    EXPECT_TRUE(bvh.any(eye, down, infinity, not_passed));
    EXPECT_FALSE(bvh.any(eye, down, 0.95, not_passed));
}

TEST(Bvh, AnEmptyHierarchyHasNoHits)
{
    const Bvh none = Mesh{}.bvh(), model(head::Model{});
    for (const Bvh* bvh : {&none, &model}) {
        EXPECT_FALSE(bvh->nearest({0, 0, 1}, {0, 0, -1}, 0, infinity));
        EXPECT_FALSE(bvh->any({0, 0, 1}, {0, 0, -1}, 10));
    }
}

TEST(Bvh, InvalidRaysHitNothing)
{
    const Bvh bvh = squares({0}).bvh();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    ASSERT_TRUE(bvh.any({0.001, 0, 1}, {0, 0, -1}, infinity));
    const std::vector<Ray> rays = {{{nan, 0, 1}, {0, 0, -1}},          {{0.001, 0, nan}, {0, 0, -1}},
                                   {{0.001, 0, 1}, {0, nan, -1}},      {{0.001, 0, 1}, {0, 0, 0}},
                                   {{0.001, 0, infinity}, {0, 0, -1}}, {{0.001, 0, 1}, {0, 0, -infinity}}};
    for (const Ray& ray : rays) {
        EXPECT_FALSE(bvh.nearest(ray.origin, ray.direction, 0, infinity));
        EXPECT_FALSE(bvh.any(ray.origin, ray.direction, infinity));
    }
    const dvec3 eye(0.001, 0, 1), down(0, 0, -1);
    EXPECT_FALSE(bvh.nearest(eye, down, nan, infinity));
    EXPECT_FALSE(bvh.nearest(eye, down, 0, nan));
    EXPECT_FALSE(bvh.nearest(eye, down, 2, 0.5));
    EXPECT_FALSE(bvh.any(eye, down, -1));
}

TEST(Bvh, DegenerateTrianglesChangeNoHit)
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                    huge = std::numeric_limits<float>::infinity();
    Mesh mesh;
    mesh.add({nan, 0, 0}, {0, 1, 0}, {1, 0, 0});
    mesh.add({0, 0, 0}, {0, 1, 0}, {huge, 0, 0});
    mesh.add({0, 0, 0.5f}, {0, 0, 0.5f}, {0, 0, 0.5f});               // a point
    mesh.add({-0.01f, 0, 0.5f}, {0.01f, 0, 0.5f}, {0.002f, 0, 0.5f}); // a line
    const Mesh good = sphere();
    for (std::size_t i = 0; i < good.indices.size(); i += 3)
        mesh.add(glm::vec3(good.corner(i)), glm::vec3(good.corner(i + 1)), glm::vec3(good.corner(i + 2)));
    const Bvh bvh = mesh.bvh(), undisturbed = good.bvh();
    Dice dice;
    for (int i = 0; i < 2000; ++i) {
        const dvec3 origin = i == 0 ? dvec3(0, 0, 1) : dice.in_cube(0.3), direction = -origin;
        auto expected = undisturbed.nearest(origin, direction, 0, infinity);
        ASSERT_TRUE(expected);
        expected->triangle += 12;
        EXPECT_TRUE(same(bvh.nearest(origin, direction, 0, infinity), expected)) << i;
    }
}

TEST(Bvh, CanBeQueriedByManyThreadsAtOnce)
{
    const Mesh mesh = soup(600);
    const Bvh bvh = mesh.bvh(), again = mesh.bvh();
    std::vector<Ray> rays;
    Dice dice;
    for (int i = 0; i < 5000; ++i)
        rays.push_back({dice.in_cube(0.4), dice.on_sphere()});
    const auto cast = [&](const Bvh& by) {
        std::vector<std::optional<Hit>> hits;
        for (const Ray& ray : rays)
            hits.push_back(by.nearest(ray.origin, ray.direction, 0, infinity));
        return hits;
    };
    const auto expected = cast(again);
    std::vector<std::vector<std::optional<Hit>>> found(4);
    {
        std::vector<std::jthread> threads;
        for (auto& hits : found)
            threads.emplace_back([&] { hits = cast(bvh); });
    }
    for (const auto& hits : found)
        EXPECT_TRUE(std::ranges::equal(hits, expected, same));
}

TEST(Bvh, MayBeMoved)
{
    Bvh bvh = squares({0}).bvh();
    const Bvh moved = std::move(bvh);
    EXPECT_TRUE(moved.any({0.001, 0, 1}, {0, 0, -1}, 2));
}

namespace {

/// The sphere as a model of three primitives: northern half, southern half, a lash in front of the middle.
head::Model lashed_sphere()
{
    const Mesh mesh = sphere();
    head::Model model;
    for (const glm::vec3& position : mesh.positions)
        model.vertices.push_back({position, glm::normalize(position), {1, 0, 0, 1}, {0, 0}});
    model.indices = mesh.indices;
    const auto half = std::uint32_t(mesh.indices.size() / 6 * 3), all = std::uint32_t(mesh.indices.size());
    const auto lash = std::uint32_t(model.vertices.size());
    for (const glm::vec3& corner :
         {glm::vec3(-0.02f, -0.02f, 0.12f), glm::vec3(0.02f, -0.02f, 0.12f), glm::vec3(0, 0.03f, 0.12f)})
        model.vertices.push_back({corner, {0, 0, 1}, {1, 0, 0, 1}, {0, 0}});
    model.indices.insert(model.indices.end(), {lash, lash + 1, lash + 2});
    model.materials.resize(3);
    model.materials[1].alpha = head::AlphaMode::Blend;
    model.primitives = {{half, all - half, 2}, {all, 3, 1}, {0, half, 0}}; // not in index order
    head::update_bounds(model);
    return model;
}

/// Brute-force version of head::first_on_ray.
std::optional<head::SurfacePoint> first_by_brute_force(const head::Model& model, const Ray& ray)
{
    Mesh mesh;
    for (const head::Vertex& vertex : model.vertices)
        mesh.positions.push_back(vertex.position);
    mesh.indices = model.indices;
    std::optional<head::SurfacePoint> found;
    double nearest = std::numeric_limits<double>::max();
    for (const head::Primitive& primitive : model.primitives) {
        if (model.materials[primitive.material].alpha == head::AlphaMode::Blend)
            continue;
        for (std::uint32_t i = primitive.first_index; i < primitive.first_index + primitive.index_count;
             i += 3)
            if (const auto hit = intersect(mesh, i, ray, Facing::Front);
                hit && hit->distance >= 0 && hit->distance < nearest)
            {
                nearest = hit->distance;
                found = {ray.origin + nearest * ray.direction, primitive.material};
            }
    }
    return found;
}

} // namespace

TEST(Bvh, HitsOnAModelNamePrimitiveAndMaterial)
{
    const head::Model model = lashed_sphere();
    const Bvh solid(model), all(model, Bvh::Triangles::All);
    const dvec3 eye(0.001, 0.002, 1), towards(0, 0, -1);
    const auto lash = all.nearest(eye, towards, 0, infinity), skin = solid.nearest(eye, towards, 0, infinity);
    ASSERT_TRUE(lash && skin);
    EXPECT_EQ(lash->primitive, 1u);
    EXPECT_EQ(lash->material, 1u);
    EXPECT_EQ(lash->triangle, model.indices.size() - 3);
    EXPECT_EQ(skin->primitive, 2u);
    EXPECT_EQ(skin->material, 0u);
    const auto through = all.nearest(eye, towards, 0, infinity, Facing::Both,
                                     [](const Hit& hit) { return hit.material != 1; });
    EXPECT_TRUE(same(through, skin));
    const auto corners = head::corners_of(model, skin->triangle);
    const dvec3 at = (1 - skin->u - skin->v) * dvec3(corners[0]) + skin->u * dvec3(corners[1]) +
                     skin->v * dvec3(corners[2]);
    EXPECT_LT(glm::distance(at, eye + skin->distance * towards), 1e-15);
}

TEST(FirstOnRay, EqualsBruteForce)
{
    const head::Model model = lashed_sphere();
    const Bvh bvh(model);
    Dice dice;
    int hits = 0;
    for (int i = 0; i < 20'000; ++i) {
        const dvec3 origin = i % 7 ? dice.in_cube(0.3) : dvec3(0, 0, 1);
        const dvec3 at = i % 3 ? dice.in_cube(0.1)
                               : dvec3(model.vertices[std::size_t(i) % model.vertices.size()].position);
        const auto expected = first_by_brute_force(model, {origin, at - origin});
        const auto found = head::first_on_ray(bvh, origin, at - origin);
        ASSERT_EQ(found.has_value(), expected.has_value()) << i;
        if (!expected)
            continue;
        ++hits;
        EXPECT_EQ(found->at, expected->at) << i;
        EXPECT_EQ(found->material, expected->material) << i;
    }
    EXPECT_GT(hits, 10'000);
}
