#include "passes/shadow.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "head/vectors.hpp"

namespace passes {
namespace {

// Looks along `forward`. The roll is arbitrary: up is the world's y or, for a nearly vertical light, -z.
glm::dmat4 light_view(const glm::dvec3& eye, const glm::dvec3& forward)
{
    const glm::dvec3 up = std::abs(forward.y) > 0.99 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    return glm::lookAtRH(eye, eye + forward, up);
}

/// x and y at unit depth (at any depth for a parallel light), and the depth.
glm::dvec3 on_plane(const glm::dmat4& view, const glm::dvec3& point, bool parallel)
{
    const glm::dvec3 seen(view * glm::dvec4(point, 1));
    return {glm::dvec2(seen) / (parallel ? 1 : -seen.z), -seen.z};
}

constexpr double footprint = 4.0 / shadow_size; // of the filter, with a margin; share of the map's width
constexpr int widths_per_octave = 4;
constexpr double narrowest = 1.0 / 4; // of the whole map: finer texels would show the mesh's facets
constexpr int steps = 8;              // along the map's width; a step is a whole number of texels

/// A square of the plane at unit depth.
struct Window
{
    glm::dvec2 low;
    double width;
};

/// The narrowest window that holds the boxes; the whole, from -half to half, when there are none.
Window window_around(std::span<const Bounds> boxes, const glm::dmat4& view, bool parallel, double half)
{
    glm::dvec2 low(half), high(-half);
    for (const Bounds& box : boxes)
        for (const glm::dvec3& corner : corners(box)) {
            const glm::dvec2 place(on_plane(view, corner, parallel));
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
    Window best{glm::dvec2(-half), 2 * half};
    for (int i = 1; !boxes.empty() && std::exp2(-double(i) / widths_per_octave) >= narrowest; ++i) {
        const double width = 2 * half * std::exp2(-double(i) / widths_per_octave), step = width / steps;
        const glm::dvec2 from = -half + step * glm::floor((low - footprint * width + half) / step);
        if (glm::any(glm::greaterThan(high + footprint * width, from + width)))
            break;
        best = {from, width};
    }
    return best;
}

/// The shadow in the `tile`-th of `count` tiles of the depth image, from left to right.
shared::Shadow in_tile(const shared::Shadow& shadow, int tile, int count)
{
    glm::mat4 place(1);
    place[0][0] = 1.f / float(count);
    place[3][0] = float(2 * tile + 1) / float(count) - 1;
    return {.clip_from_world = place * shadow.clip_from_world,
            .clip_plane_from_world = glm::transpose(glm::inverse(place)) * shadow.clip_plane_from_world,
            .texel = shadow.texel,
            .step = shadow.step / glm::vec2(count, 1)};
}

} // namespace

std::optional<shared::Shadow> fit_shadow(const optics::Light& light, const glm::vec3& box_min,
                                         const glm::vec3& box_max, std::span<const Bounds> seen,
                                         std::uint32_t size)
{
    const glm::dvec3 center = glm::dvec3(box_min + box_max) * 0.5;
    const double radius = glm::length(glm::dvec3(box_max) - center);
    const glm::dvec3 position = head::to_glm(light.position), direction = head::to_glm(light.direction);
    const bool parallel = light.kind == optics::LightKind::Directional;

    const glm::dvec3 eye = parallel ? center + 2 * radius * direction : position;
    const double distance = glm::length(center - eye);
    if (!(radius > 0) || distance < 1.2 * radius) // the frustum would be wider than about 110 degrees
        return std::nullopt;
    const glm::dmat4 view = light_view(eye, (center - eye) / distance);

    // Half width and height at unit depth (at any depth for a parallel light), and the span of depths.
    double half = 0, near = distance, far = distance;
    for (const glm::dvec3& corner : corners({box_min, box_max})) {
        const glm::dvec3 place = on_plane(view, corner, parallel);
        half = std::max({half, std::abs(place.x), std::abs(place.y)});
        near = std::min(near, place.z);
        far = std::max(far, place.z);
    }
    const double margin = 0.01 * radius;
    near = std::max(near - margin, 0.05 * distance);
    far += margin;
    half *= 1 + footprint;

    const Window window = window_around(seen, view, parallel, half);
    const glm::dvec2 low = window.low, high = window.low + window.width;
    glm::dmat4 projection =
        parallel ? glm::orthoRH_ZO(low.x, high.x, low.y, high.y, near, far)
                 : glm::frustumRH_ZO(low.x * near, high.x * near, low.y * near, high.y * near, near, far);
    for (int column = 0; column < 4; ++column)
        projection[column][1] = -projection[column][1]; // Vulkan's y points down
    const glm::dmat4 clip_from_world = projection * view;
    return shared::Shadow{.clip_from_world = glm::mat4(clip_from_world),
                          .clip_plane_from_world = glm::mat4(glm::transpose(glm::inverse(clip_from_world))),
                          .texel = static_cast<float>(window.width / size),
                          .step = glm::vec2(2.f / float(size))};
}

Shadows fit_shadows(std::span<const optics::Light> lights, const glm::vec3& box_min, const glm::vec3& box_max,
                    std::span<const Bounds> seen, std::uint32_t size)
{
    Shadows shadows{}; // zero where no light is: what the pass remembers must not change
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (const auto shadow = fit_shadow(lights[i], box_min, box_max, seen, size)) {
            shadows.lights[i] = *shadow;
            shadows.casting |= 1u << i;
        }
    const int count = std::popcount(shadows.casting);
    for (std::size_t i = 0, tile = 0; i < lights.size(); ++i)
        if ((shadows.casting >> i & 1) != 0)
            shadows.lights[i] = in_tile(shadows.lights[i], int(tile++), count);
    return shadows;
}

graph::ImageId add_shadows(graph::Graph& graph, const std::string& name, const Shadows& shadows,
                           const graph::Mesh& mesh, std::span<const head::Primitive> casters,
                           std::uint32_t size)
{
    const auto count = std::uint32_t(std::popcount(shadows.casting));
    const graph::ImageId depth = graph.image(name + " depth", {count * size, size, VK_FORMAT_D32_SFLOAT});
    graph::RasterPass& pass = graph.raster(name);
    pass.depth(depth);
    for (std::size_t light = 0; light < std::size(shadows.lights); ++light) {
        if ((shadows.casting >> light & 1) == 0)
            continue;
        for (const head::Primitive& caster : casters) {
            graph::Draw& draw = pass.draw("shadow");
            draw.uniform("ShadowBlock", shadows.lights[light]);
            draw.mesh = &mesh;
            draw.first_index = caster.first_index;
            draw.index_count = caster.index_count;
            draw.cull_back_faces = false; // a bust is open at the bottom, and thin sheets are one-sided
        }
    }
    return depth;
}

} // namespace passes
