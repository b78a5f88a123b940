#include "head/curvature.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace {

using std::numbers::pi;

/// A grid of (steps + 1)^2 vertices, u and v from 0 to 1.
head::Model grid(int steps, const std::function<head::Vertex(double, double)>& vertex)
{
    head::Model model;
    for (int j = 0; j <= steps; ++j)
        for (int i = 0; i <= steps; ++i)
            model.vertices.push_back(vertex(double(i) / steps, double(j) / steps));
    for (int j = 0; j < steps; ++j)
        for (int i = 0; i < steps; ++i) {
            const auto a = std::uint32_t(j * (steps + 1) + i), b = a + std::uint32_t(steps) + 1;
            for (const std::uint32_t v : {a, b, a + 1, a + 1, b, b + 1})
                model.indices.push_back(v);
        }
    return model;
}

/// Closed at u = 0 and 1, where it has a seam, and with triangles without area at the poles.
head::Model ball(double radius_m, int steps, double noise = 0)
{
    std::mt19937 random(1);
    std::normal_distribution<double> off(0, noise);
    return grid(steps, [&](double u, double v) {
        const double phi = 2 * pi * (u == 1 ? 0 : u), theta = pi * v;
        const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
        const glm::dvec3 bent = glm::normalize(n + glm::dvec3(off(random), off(random), off(random)));
        return head::Vertex{glm::vec3(radius_m * n), glm::vec3(bent), {}, glm::vec2(u, v)};
    });
}

TEST(Curvature, OfABallIsOneOverItsRadiusAlsoAtSeamAndPoles)
{
    for (const double radius : {.004, .02, .09}) {
        head::Model model = ball(radius, 60);
        head::compute_curvature(model);
        for (const head::Vertex& vertex : model.vertices)
            for (int k = 0; k < 2; ++k)
                EXPECT_NEAR(vertex.curvature[k] * radius, 1, .05);
    }
}

TEST(Curvature, OfAPlaneIsNothingAndOfACylinderLessThanOfABall)
{
    head::Model plane = grid(8, [](double u, double v) {
        return head::Vertex{glm::vec3(glm::dvec3(u, v, 0) * .1), {0, 0, 1}, {}, {}};
    });
    head::compute_curvature(plane);
    for (const head::Vertex& vertex : plane.vertices)
        EXPECT_EQ(vertex.curvature, glm::vec2(0));

    head::Model cylinder = grid(40, [](double u, double v) {
        const double phi = u;
        return head::Vertex{glm::vec3(.05 * std::sin(phi), .05 * v, .05 * std::cos(phi)),
                            glm::vec3(std::sin(phi), 0, std::cos(phi)), {}, {}};
    });
    head::compute_curvature(cylinder);
    glm::dvec2 sum(0);
    for (const head::Vertex& vertex : cylinder.vertices)
        sum += glm::dvec2(vertex.curvature) * .05 / double(cylinder.vertices.size());
    EXPECT_NEAR(sum.x, .5, .1); // a grid's edges have three directions, not all
    EXPECT_NEAR(sum.y, std::sqrt(.5), .1);
}

TEST(Curvature, OfAHollowIsNegativeInTheMean)
{
    head::Model model = ball(.02, 40);
    for (head::Vertex& vertex : model.vertices)
        vertex.normal = -vertex.normal;
    head::compute_curvature(model);
    for (const head::Vertex& vertex : model.vertices) {
        EXPECT_NEAR(vertex.curvature.x * .02, -1, .05);
        EXPECT_NEAR(vertex.curvature.y * .02, 1, .05);
    }
}

// A scan's normals are noisy, more so the finer it is.
TEST(Curvature, OfANoisyScanIsNearThatOfTheSurface)
{
    head::Model model = ball(.02, 200, .05); // edges of .3 mm
    head::compute_curvature(model);
    double sum = 0;
    for (const head::Vertex& vertex : model.vertices)
        sum += double(vertex.curvature.y) * .02 / double(model.vertices.size());
    EXPECT_LT(sum, 1.5); // 12 from the normals as they are
    EXPECT_GT(sum, .8);
}

TEST(Curvature, HasABoundAndSurvivesNoArea)
{
    head::Model fold = grid(2, [](double u, double v) {
        return head::Vertex{glm::vec3(1e-5 * u, 1e-5 * v, 0), glm::vec3(u < .5 ? -1 : 1, 0, 0), {}, {}};
    });
    for (int k = 0; k < 3; ++k)
        fold.indices.push_back(0); // no edge at all
    fold.vertices.push_back({glm::vec3(1), glm::vec3(0, 0, 1), {}, {}});
    head::compute_curvature(fold);
    for (const head::Vertex& vertex : fold.vertices) {
        EXPECT_LE(std::abs(vertex.curvature.x), 1000);
        EXPECT_LE(vertex.curvature.y, 1000);
    }
    EXPECT_EQ(fold.vertices.back().curvature, glm::vec2(0));
}

} // namespace
