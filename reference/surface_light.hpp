// The light that a head's skin receives, at samples all over it, and sums over them by an octree: the two
// passes of H. Jensen, J. Buhler 2002, "A rapid hierarchical rendering technique for translucent materials".
//
// Pass 1. The authors spread samples by repulsion and give each the same area. Here every triangle is cut
// into equal parts, each with a sample in its middle and its own area, which is exact for any mesh. Positions
// and tree stand as long as the head does; illuminate() fills in the light of the day's lights. Pass 2.
// gathered() sums profile x light x area. A voxel that looks small from the point counts as one sample.
#pragma once
#include <optional>
#include <vector>

#include "reference/path_tracer.hpp"

namespace reference {

class SurfaceLight
{
  public:
    /// Samples repeat at most every `spacing_m` along the legs of a right triangle. Keeps nothing of the
    /// scene.
    SurfaceLight(const scene::LoadedScene& scene, double spacing_m);

    /// Pass 1: of each sample the lights' light, and the mean of `rays` directions for the rest, with this
    /// tracer's bounces. All cores work; the result does not depend on their number.
    void illuminate(const Surfaces& surfaces, const PathTracer& tracer, unsigned rays);

    /// Pass 2, for a point within `reach_m` of which the profile ends. `profile(r^2)`: base::Color, per m^2.
    /// A voxel counts as one sample when its area over r^2, the authors' solid angle, is below `solid_angle`
    /// and the point lies outside.
    template <class Profile>
    base::Color gathered(const glm::dvec3& at, double reach_m, double solid_angle,
                         const Profile& profile) const;

    /// Depth of a point inside below the tangent plane of the nearest sample, m; none when a sample is nearer
    /// than `least_m`.
    std::optional<double> depth(const glm::dvec3& at, double least_m) const;

    double spacing_m() const { return spacing_m_; }
    std::size_t size() const { return samples_.size(); }
    double area_m2() const; // of all samples
    std::size_t bytes() const { return samples_.size() * sizeof(Sample) + nodes_.size() * sizeof(Node); }

  private:
    struct Sample
    {
        glm::vec3 at, power; // m; light x area, the light as the radiance of a white diffuser
        float area;          // m^2
        std::uint32_t triangle;
        glm::vec2 barycentric;
        glm::vec3 normal; // of the triangle
    };
    struct Node // depth first: a node's first child follows it
    {
        glm::vec3 at, power; // power's mean place; where there is none, the area's
        float area;
        glm::vec3 centre;
        float half;                       // of the voxel's edge
        std::uint32_t first, count, skip; // samples; the node after all below this one
        bool leaf;
    };
    void build(std::uint32_t first, std::uint32_t count, const glm::vec3& centre, float half);
    void sum_up();

    std::vector<Sample> samples_;
    std::vector<Node> nodes_;
    double spacing_m_;
};

template <class Profile>
base::Color SurfaceLight::gathered(const glm::dvec3& at, double reach_m, double solid_angle,
                                   const Profile& profile) const
{
    const glm::vec3 here(at);
    const float reach = float(reach_m), reach2 = reach * reach, wide = float(solid_angle);
    base::Color sum(0, 0, 0);
    const auto add = [&](const glm::vec3& power, float r2) {
        sum += base::Color(double(power.x), double(power.y), double(power.z)).mul(profile(double(r2)));
    };
    for (std::size_t i = 0; i < nodes_.size();) {
        const Node& node = nodes_[i];
        const glm::vec3 aside = glm::abs(here - node.centre) - node.half;
        const glm::vec3 to_box = glm::max(aside, glm::vec3(0));
        if (node.power == glm::vec3(0) || glm::dot(to_box, to_box) > reach2) {
            i = node.skip;
            continue;
        }
        const glm::vec3 offset = here - node.at;
        const float r2 = glm::dot(offset, offset);
        const bool outside = std::max({aside.x, aside.y, aside.z}) > 0;
        if (outside && node.area < wide * r2)
            add(node.power, r2);
        else if (node.leaf)
            for (std::uint32_t s = node.first; s < node.first + node.count; ++s) {
                const glm::vec3 between = here - samples_[s].at;
                add(samples_[s].power, glm::dot(between, between));
            }
        else {
            ++i;
            continue;
        }
        i = node.skip;
    }
    return sum;
}

} // namespace reference
