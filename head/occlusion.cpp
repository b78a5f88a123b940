#include "head/occlusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <opencv2/core/utility.hpp>
#include <tuple>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/input_error.hpp"

namespace head {
namespace {

constexpr float start_offset = 3e-4f; // metres along the normal, to avoid hitting the vertex's own triangles

constexpr float deepest = 0.02f;       // metres: thicker bodies let no light through
constexpr double typical_depth = 2e-3; // metres, over which light in a body falls to 1/e
constexpr double least_passed = 1e-4;  // of the light; less is none
constexpr double most_thinness = 2000; // 1/m

constexpr std::uint64_t occlusion_version = 2;   // goes up when the same mesh gets other values
constexpr int most_rays = 128, fewest_rays = 16; // of a point
constexpr std::size_t rays_in_all = 16'000'000;  // beyond 125,000 points each gets fewer
constexpr float smoothed_over = 2e-3f; // metres: occlusion hardly changes along an edge as short as this

/// Directions into the hemisphere around a normal, as dense as the cosine. The same at every point but for a
/// turn about the normal.
class Hemisphere
{
  public:
    // A Fibonacci spiral on the unit disc, projected to the hemisphere: density proportional to the cosine
    // (Malley's method).
    explicit Hemisphere(int rays)
    {
        for (int i = 0; i < rays; ++i) {
            const float r2 = (static_cast<float>(i) + 0.5f) / static_cast<float>(rays);
            const float angle = glm::two_pi<float>() * glm::fract(static_cast<float>(i) * 0.61803399f);
            directions_.emplace_back(std::sqrt(r2) * std::cos(angle), std::sqrt(r2) * std::sin(angle),
                                     std::sqrt(1.0f - r2));
        }
    }

    template <typename Use> // void(direction)
    void for_each(const glm::vec3& n, int point, const Use& use) const
    {
        const glm::vec3 helper = std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        const glm::vec3 x = glm::normalize(glm::cross(helper, n)), y = glm::cross(n, x);
        const float turn = glm::two_pi<float>() * glm::fract(static_cast<float>(point) * 0.75487767f);
        const glm::vec3 tx = std::cos(turn) * x + std::sin(turn) * y,
                        ty = std::cos(turn) * y - std::sin(turn) * x;
        for (const glm::vec3& d : directions_)
            use(glm::dvec3(d.x * tx + d.y * ty + d.z * n));
    }

  private:
    std::vector<glm::vec3> directions_;
};

/// Vertices that differ in texture coordinates only: of one place and normal.
struct OcclusionPoints
{
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint32_t> of_vertex; // no_point: of a vertex that no opaque triangle uses
    static constexpr std::uint32_t no_point = ~0u;
};

bool occludes(const Model& model, std::uint32_t material)
{
    return model.materials[material].alpha == AlphaMode::Opaque;
}

template <typename Use> // void(first index of a triangle)
void for_each_opaque_triangle(const Model& model, const Use& use)
{
    for (const Primitive& primitive : model.primitives)
        if (occludes(model, primitive.material))
            for (std::uint32_t i = 0; i + 2 < primitive.index_count; i += 3)
                use(primitive.first_index + i);
}

OcclusionPoints occlusion_points(const Model& model)
{
    OcclusionPoints points;
    points.of_vertex.assign(model.vertices.size(), OcclusionPoints::no_point);
    std::vector<std::uint8_t> used(model.vertices.size(), 0);
    for_each_opaque_triangle(model, [&](std::uint32_t first) {
        for (std::uint32_t k = 0; k < 3; ++k)
            used[model.indices[first + k]] = 1;
    });
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < used.size(); ++i)
        if (used[i] != 0)
            order.push_back(i);
    const auto key = [&](std::uint32_t i) {
        const Vertex& v = model.vertices[i];
        return std::tuple(v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y, v.normal.z);
    };
    std::ranges::stable_sort(order, {}, key);
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (k == 0 || key(order[k]) != key(order[k - 1])) {
            points.positions.push_back(model.vertices[order[k]].position);
            points.normals.push_back(model.vertices[order[k]].normal);
        }
        points.of_vertex[order[k]] = std::uint32_t(points.positions.size() - 1);
    }
    return points;
}

/// Means over the neighbours along short edges, so many times: the noise of few rays goes.
void smooth(std::vector<float>& open, const Model& model, const OcclusionPoints& points, int times)
{
    if (times <= 0)
        return;
    std::vector<std::array<std::uint32_t, 2>> edges;
    for_each_opaque_triangle(model, [&](std::uint32_t first) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = points.of_vertex[model.indices[first + k]],
                                b = points.of_vertex[model.indices[first + (k + 1) % 3]];
            if (a != b && glm::distance(points.positions[a], points.positions[b]) < smoothed_over)
                edges.push_back({a, b});
        }
    });
    std::vector<float> sums(open.size()), weights(open.size());
    for (; times > 0; --times) {
        sums = open;
        std::ranges::fill(weights, 1.f);
        for (const auto& [a, b] : edges) { // in the mesh's order: the same sums for any number of threads
            sums[a] += 0.5f * open[b];     // an inner edge comes twice
            sums[b] += 0.5f * open[a];
            weights[a] += 0.5f;
            weights[b] += 0.5f;
        }
        for (std::size_t i = 0; i < open.size(); ++i)
            open[i] = sums[i] / weights[i];
    }
}

/// The slab, in e-foldings, through which this share comes of light from all around that goes straight: of 2
/// E3(x).
double slab_that_passes(double share)
{
    double low = 0, high = 20;
    for (int i = 0; i < 40; ++i) {
        const double x = (low + high) / 2;
        const double passed = std::exp(-x) * (1 - x) - x * x * std::expint(-x);
        (passed > share ? low : high) = x;
    }
    return low;
}

/// Vertex::thinness of each point, from the occlusion of all.
std::vector<float> thinness(const Model& model, const Bvh& bvh, const OcclusionPoints& points,
                            std::span<const float> open, int rays)
{
    const Hemisphere hemisphere(rays);
    std::vector<float> result(points.positions.size());
    cv::parallel_for_(cv::Range(0, int(result.size())), [&](const cv::Range& range) {
        for (int p = range.start; p < range.end; ++p) {
            const glm::vec3 inward = -points.normals[p];
            const glm::dvec3 start(points.positions[p] + start_offset * inward);
            double passed = 0;
            hemisphere.for_each(inward, p, [&](const glm::dvec3& direction) {
                const auto hit = bvh.nearest(start, direction, 0, deepest, Facing::Both,
                                             [&](const Hit& at) { return occludes(model, at.material); });
                if (!hit || hit->front)
                    return; // no end near, or another body begins
                const auto open_at = [&](std::uint32_t corner) {
                    return double(open[points.of_vertex[model.indices[hit->triangle + corner]]]);
                };
                const double length = hit->distance + start_offset / glm::dot(direction, glm::dvec3(inward));
                passed += std::exp(-length / typical_depth) *
                          ((1 - hit->u - hit->v) * open_at(0) + hit->u * open_at(1) + hit->v * open_at(2));
            });
            passed /= rays;
            if (passed > least_passed)
                result[p] = float(std::min(1 / (typical_depth * slab_that_passes(passed)), most_thinness));
        }
    });
    return result;
}

/// Two bytes for each vertex, the same whether computed or read: the occlusion of all, 255 open, as fine as
/// in a map, and then the thinness of all.
std::vector<std::uint8_t> baked_bytes(const Model& model, const Bvh& bvh)
{
    const OcclusionPoints points = occlusion_points(model);
    const std::size_t count = std::max<std::size_t>(points.positions.size(), 1);
    const int rays = std::clamp(int(rays_in_all / count), fewest_rays, most_rays);
    std::vector<float> open =
        ambient_occlusion(bvh, points.positions, points.normals, rays, occlusion_reach,
                          [&](const Hit& hit) { return occludes(model, hit.material); });
    smooth(open, model, points, (most_rays - rays + 3 * rays - 1) / (3 * rays)); // by about 3 rings' worth
    const std::vector<float> thin = thinness(model, bvh, points, open, rays);
    const std::size_t vertices = model.vertices.size();
    std::vector<std::uint8_t> bytes(2 * vertices, 255);
    std::fill(bytes.begin() + std::ptrdiff_t(vertices), bytes.end(), std::uint8_t(0));
    for (std::size_t i = 0; i < vertices; ++i)
        if (const std::uint32_t point = points.of_vertex[i]; point != OcclusionPoints::no_point) {
            bytes[i] = std::uint8_t(std::lround(255 * open[point]));
            bytes[vertices + i] = std::uint8_t(std::lround(255 / most_thinness * thin[point]));
        }
    return bytes;
}

void set_baked(Model& model, std::span<const std::uint8_t> bytes)
{
    const std::size_t vertices = model.vertices.size();
    const bool has_map = has_occlusion_map(model);
    for (std::size_t i = 0; i < vertices; ++i) {
        if (!has_map)
            model.vertices[i].occlusion = float(bytes[i]) / 255;
        model.vertices[i].thinness = float(bytes[vertices + i]) * float(most_thinness / 255);
    }
}

/// Of all that the bytes depend on.
std::uint64_t occlusion_key(const Model& model)
{
    base::Hash hash;
    hash.add(occlusion_version).add(model.vertices.size());
    for (const Vertex& vertex : model.vertices)
        for (const glm::vec3& v : {vertex.position, vertex.normal})
            hash.add(v.x).add(v.y).add(v.z);
    hash.add(std::as_bytes(std::span(model.indices)));
    for (const Primitive& primitive : model.primitives)
        hash.add(primitive.first_index).add(primitive.index_count).add(occludes(model, primitive.material));
    return hash.value();
}

std::array<std::uint8_t, 8> checksum(std::span<const std::uint8_t> bytes)
{
    const std::uint64_t value = base::Hash().add(std::as_bytes(bytes)).value();
    std::array<std::uint8_t, 8> result;
    std::memcpy(result.data(), &value, result.size());
    return result;
}

/// The file's bytes without its checksum; nothing when it is missing or damaged.
std::vector<std::uint8_t> read_baked(const std::filesystem::path& file, std::size_t count)
{
    std::error_code ignored;
    if (std::filesystem::file_size(file, ignored) != count + 8 || ignored)
        return {};
    try {
        std::vector<std::uint8_t> bytes = base::read_file(file, count + 8);
        if (const auto sum = checksum(std::span(bytes).first(count));
            bytes.size() != count + 8 || !std::equal(sum.begin(), sum.end(), bytes.end() - 8))
            return {};
        bytes.resize(count);
        return bytes;
    } catch (const base::InputError&) {
        return {};
    }
}

} // namespace

std::vector<float> ambient_occlusion(const Bvh& bvh, std::span<const glm::vec3> positions,
                                     std::span<const glm::vec3> normals, int rays, float reach,
                                     HitFilter accept)
{
    const Hemisphere hemisphere(rays);
    std::vector<float> open(positions.size());
    cv::parallel_for_(cv::Range(0, static_cast<int>(positions.size())), [&](const cv::Range& range) {
        for (int v = range.start; v < range.end; ++v) {
            const glm::dvec3 start(positions[v] + start_offset * normals[v]);
            int free = 0;
            hemisphere.for_each(normals[v], v, [&](const glm::dvec3& direction) {
                free += !bvh.any(start, direction, reach, accept);
            });
            open[v] = static_cast<float>(free) / static_cast<float>(rays);
        }
    });
    return open;
}

bool has_occlusion_map(const Model& model)
{
    return std::ranges::any_of(model.materials, [](const Material& m) { return !m.occlusion.empty(); });
}

std::string bake_occlusion(Model& model, const Bvh& bvh, const std::filesystem::path& folder)
{
    const std::filesystem::path file = folder / fmt::format("{:016x}.bin", occlusion_key(model));
    if (const auto kept = read_baked(file, 2 * model.vertices.size()); !kept.empty()) {
        set_baked(model, kept);
        return {};
    }
    std::vector<std::uint8_t> bytes = baked_bytes(model, bvh);
    set_baked(model, bytes);
    const auto sum = checksum(bytes);
    bytes.insert(bytes.end(), sum.begin(), sum.end());
    try {
        base::make_folder(folder);
        base::write_bytes(file, bytes);
        return {};
    } catch (const base::InputError& error) {
        return fmt::format("occlusion and thin parts are not kept for the next time: {}: {}", error.where(),
                           error.problem());
    }
}

} // namespace head
