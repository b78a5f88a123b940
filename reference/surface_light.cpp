#include "reference/surface_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"

namespace reference {
namespace {

constexpr std::uint32_t leaf_samples = 8;
constexpr float smallest_half_m = 1e-6f;
constexpr std::uint64_t light_seed = 0x11;

/// Barycentric places of the middles of n^2 equal parts of a triangle.
template <class Put>
void each_part(std::uint32_t n, const Put& put)
{
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; i + j < n; ++j) {
            put(glm::dvec2(i + 1. / 3, j + 1. / 3) / double(n));
            if (i + j + 1 < n)
                put(glm::dvec2(i + 2. / 3, j + 2. / 3) / double(n));
        }
}

} // namespace

SurfaceLight::SurfaceLight(const scene::LoadedScene& scene, double spacing_m) : spacing_m_(spacing_m)
{
    const head::Model& model = *scene.head->model;
    glm::vec3 least(1e30f), most(-1e30f);
    for (const head::Primitive& primitive : model.primitives) {
        if (primitive.material != scene.head->skin)
            continue;
        for (std::uint32_t t = primitive.first_index; t < primitive.first_index + primitive.index_count;
             t += 3) {
            std::array<glm::dvec3, 3> corners;
            for (std::uint32_t k = 0; k < 3; ++k)
                corners[k] = glm::dvec3(model.vertices[model.indices[t + k]].position);
            const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            const double area = glm::length(across) / 2;
            if (!(area > 0) || !std::isfinite(area))
                continue;
            const double longest =
                std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                          glm::distance(corners[2], corners[0])});
            const auto n =
                std::uint32_t(std::clamp(std::ceil(longest / (std::numbers::sqrt2 * spacing_m)), 1., 1000.));
            each_part(n, [&](const glm::dvec2& uv) {
                const glm::vec3 at((1 - uv.x - uv.y) * corners[0] + uv.x * corners[1] + uv.y * corners[2]);
                samples_.push_back({at, glm::vec3(0), float(area / n / n), t, glm::vec2(uv),
                                    glm::vec3(across / (2 * area))});
                least = glm::min(least, at);
                most = glm::max(most, at);
            });
        }
    }
    if (samples_.empty())
        return;
    const glm::vec3 extent = most - least;
    build(0, std::uint32_t(samples_.size()), (least + most) / 2.f,
          std::max({extent.x, extent.y, extent.z}) / 2 + smallest_half_m);
    sum_up();
}

void SurfaceLight::build(std::uint32_t first, std::uint32_t count, const glm::vec3& centre, float half)
{
    const std::size_t own = nodes_.size();
    const bool leaf = count <= leaf_samples || half < smallest_half_m;
    nodes_.push_back({centre, glm::vec3(0), 0, centre, half, first, count, 0, leaf});
    if (!leaf) {
        auto begin = samples_.begin() + first;
        const auto end = begin + count;
        for (int octant = 0; octant < 8; ++octant) {
            const auto middle = std::partition(begin, end, [&](const Sample& sample) {
                return octant ==
                       (sample.at.x > centre.x) + 2 * (sample.at.y > centre.y) + 4 * (sample.at.z > centre.z);
            });
            if (middle != begin) {
                const glm::vec3 side(octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1);
                build(std::uint32_t(begin - samples_.begin()), std::uint32_t(middle - begin),
                      centre + side * half / 2.f, half / 2);
            }
            begin = middle;
        }
    }
    nodes_[own].skip = std::uint32_t(nodes_.size());
}

void SurfaceLight::sum_up()
{
    for (std::size_t i = nodes_.size(); i-- > 0;) { // children before their parents
        Node& node = nodes_[i];
        double area = 0, weight = 0;
        glm::dvec3 power(0), by_area(0), by_power(0);
        const auto add = [&](const glm::vec3& at, const glm::vec3& its_power, float its_area) {
            const double brightness = double(its_power.x) + double(its_power.y) + double(its_power.z);
            area += double(its_area);
            weight += brightness;
            power += glm::dvec3(its_power);
            by_area += double(its_area) * glm::dvec3(at);
            by_power += brightness * glm::dvec3(at);
        };
        if (node.leaf)
            for (std::uint32_t s = node.first; s < node.first + node.count; ++s)
                add(samples_[s].at, samples_[s].power, samples_[s].area);
        else
            for (std::uint32_t c = std::uint32_t(i) + 1; c < node.skip; c = nodes_[c].skip)
                add(nodes_[c].at, nodes_[c].power, nodes_[c].area);
        node.area = float(area);
        node.power = glm::vec3(power);
        node.at = glm::vec3(weight > 0 ? by_power / weight : by_area / area);
    }
}

void SurfaceLight::illuminate(const Surfaces& surfaces, const PathTracer& tracer, unsigned rays)
{
    constexpr std::size_t block = 512;
    base::in_parallel((samples_.size() + block - 1) / block, 0, [&](std::size_t b) {
        for (std::size_t s = b * block; s < std::min(samples_.size(), (b + 1) * block); ++s) {
            Sample& sample = samples_[s];
            const SurfacePoint point = surfaces.point(
                SurfaceHit{.triangle = sample.triangle, .barycentric = glm::dvec2(sample.barycentric)});
            base::Color light = tracer.direct(point, point.normal);
            Random random(light_seed, s, 0);
            for (unsigned ray = 0; ray < rays; ++ray)
                light += 1. / rays * tracer.indirect(point, point.normal, point.skin.skin.albedo, 0, random);
            sample.power = sample.area * glm::vec3(light[0], light[1], light[2]);
        }
    });
    sum_up();
}

std::optional<double> SurfaceLight::depth(const glm::dvec3& at, double least_m) const
{
    constexpr float growth = 1.4f, farthest_m = 10;
    const glm::vec3 here(at);
    // Most often a sample is nearer than least_m, or little farther: the search grows from there.
    for (float radius = float(least_m); radius < farthest_m; radius *= growth) {
        const bool first = radius == float(least_m);
        float nearest2 = radius * radius;
        const Sample* nearest = nullptr;
        for (std::size_t i = 0; i < nodes_.size();) {
            const Node& node = nodes_[i];
            const glm::vec3 to_box = glm::max(glm::abs(here - node.centre) - node.half, glm::vec3(0));
            if (glm::dot(to_box, to_box) > nearest2) {
                i = node.skip;
                continue;
            }
            if (node.leaf)
                for (std::uint32_t s = node.first; s < node.first + node.count; ++s) {
                    const glm::vec3 between = here - samples_[s].at;
                    if (const float r2 = glm::dot(between, between); r2 < nearest2) {
                        if (first)
                            return std::nullopt;
                        nearest2 = r2;
                        nearest = &samples_[s];
                    }
                }
            ++i; // below a node its children follow, below a leaf the next node
        }
        if (nearest)
            return std::max(double(glm::dot(nearest->at - here, nearest->normal)), least_m);
    }
    return std::nullopt;
}

double SurfaceLight::area_m2() const
{
    double area = 0;
    for (const Sample& sample : samples_)
        area += double(sample.area);
    return area;
}

} // namespace reference
