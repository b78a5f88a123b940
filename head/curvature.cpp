#include "head/curvature.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "head/weld.hpp"

namespace head {
namespace {

constexpr double averaged_m = 1e-3;     // over which normals are averaged
constexpr double most_curvature = 1000; // 1/m
constexpr int most_rounds = 12;         // of averaging: finer meshes are averaged over less

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Of triangles; an edge of two triangles is there twice.
Edges edges_of(const Model& model, const std::vector<std::uint32_t>& place)
{
    Edges edges;
    edges.reserve(model.indices.size());
    for (std::size_t i = 0; i + 2 < model.indices.size(); i += 3)
        for (std::size_t c = 0; c < 3; ++c)
            if (const std::pair edge{place[model.indices[i + c]], place[model.indices[i + (c + 1) % 3]]};
                edge.first != edge.second)
                edges.push_back(edge);
    return edges;
}

glm::dvec3 unit(const glm::dvec3& v)
{
    const double length = glm::length(v);
    return length > 1e-12 ? v / length : glm::dvec3(0);
}

struct Surface
{
    std::vector<glm::dvec3> at, normal; // metres; about unit
};

/// Each place and normal becomes the mean of its own and its neighbours', the nearer the heavier. Both by the same weights:
/// then a ball stays a ball, however its triangles lie.
void average(Surface& surface, const Edges& edges)
{
    Surface sum = surface;
    std::vector<double> weights(surface.at.size(), 1);
    for (const auto& [a, b] : edges) {
        const glm::dvec3 between = surface.at[a] - surface.at[b];
        const double weight = std::exp(-glm::dot(between, between) / (averaged_m * averaged_m));
        for (const auto& [to, from] : {std::pair(a, b), std::pair(b, a)}) {
            sum.at[to] += weight * surface.at[from];
            sum.normal[to] += weight * surface.normal[from];
            weights[to] += weight;
        }
    }
    for (std::size_t p = 0; p < weights.size(); ++p) {
        surface.at[p] = sum.at[p] / weights[p];
        surface.normal[p] = sum.normal[p] / weights[p];
    }
}

int rounds_of(const Edges& edges, const std::vector<glm::dvec3>& at)
{
    double length = 0;
    for (const auto& [a, b] : edges)
        length += glm::distance(at[a], at[b]);
    const double mean = length / double(std::max<std::size_t>(edges.size(), 1));
    return int(std::min<double>(averaged_m * averaged_m / std::max(mean * mean, 1e-12), most_rounds));
}

} // namespace

void compute_curvature(Model& model)
{
    const std::size_t count = model.vertices.size(); // at least as many as places
    const std::vector<std::uint32_t> place = weld<3>(count, [&](std::size_t v) {
        const glm::vec3& p = model.vertices[v].position;
        return Key<3>{{bits_of(p.x), bits_of(p.y), bits_of(p.z)}};
    });
    const Edges edges = edges_of(model, place);
    Surface surface{std::vector<glm::dvec3>(count), std::vector<glm::dvec3>(count, glm::dvec3(0))};
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
        surface.at[place[v]] = model.vertices[v].position;
        surface.normal[place[v]] += glm::dvec3(model.vertices[v].normal);
    }
    for (glm::dvec3& normal : surface.normal)
        normal = unit(normal);
    for (int round = rounds_of(edges, surface.at); round > 0; --round)
        average(surface, edges);

    // The normal turns by S e along an edge e, S the shape operator. Over all directions the mean of e.S e / |e|^2 is the
    // mean of the principal curvatures, and that of |S e|^2 / |e|^2 the mean of their squares.
    std::vector<double> bent(count, 0), turned(count, 0), length(count, 0);
    for (const auto& [a, b] : edges) {
        const glm::dvec3 turn = surface.normal[a] - surface.normal[b],
                         between = surface.at[a] - surface.at[b];
        for (const std::uint32_t end : {a, b}) {
            bent[end] += glm::dot(turn, between);
            turned[end] += glm::dot(turn, turn);
            length[end] += glm::dot(between, between);
        }
    }
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
        const std::uint32_t p = place[v];
        model.vertices[v].curvature = {0, 0};
        if (length[p] > 0)
            model.vertices[v].curvature =
                glm::vec2(std::clamp(bent[p] / length[p], -most_curvature, most_curvature),
                          std::min(std::sqrt(turned[p] / length[p]), most_curvature));
    }
}

} // namespace head
