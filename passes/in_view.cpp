#include "passes/in_view.hpp"

#include <algorithm>
#include <optional>

namespace passes {
namespace {

constexpr int grid_cells = 24; // along the longest side of the head
/// Pixels by which a device may move a corner: it computes in float and rounds to 1/256 of a pixel.
constexpr double snapping = 1.0 / 128;

/// Bits of the sides of the view that a point lies beyond; the view is made larger by `margin`, a share of
/// its half width and height. Beyond its far side lies nothing: the view holds the head.
unsigned beyond(const glm::dvec4& clip, const glm::dvec2& margin)
{
    const double x = (1 + margin.x) * clip.w, y = (1 + margin.y) * clip.w;
    return unsigned(clip.x < -x) | unsigned(clip.x > x) << 1 | unsigned(clip.y < -y) << 2 |
           unsigned(clip.y > y) << 3 | unsigned(clip.z < 0) << 4;
}

/// Counter-clockwise in the picture, or so nearly seen from the edge that a device may draw it.
bool turned_to_viewer(const std::array<glm::dvec4, 3>& clip, const glm::dvec2& half_size)
{
    std::array<glm::dvec2, 3> pixel;
    for (std::size_t k = 0; k < 3; ++k) {
        if (clip[k].w <= 0)
            return true; // partly behind the viewer: not decided here
        pixel[k] = half_size * glm::dvec2(clip[k]) / clip[k].w;
    }
    const glm::dvec2 ab = pixel[1] - pixel[0], ac = pixel[2] - pixel[0];
    const double perimeter = glm::length(ab) + glm::length(ac) + glm::length(ac - ab);
    return ab.x * ac.y - ab.y * ac.x < snapping * (perimeter + snapping); // y points down
}

} // namespace

std::array<glm::dvec3, 8> corners(const Bounds& box)
{
    std::array<glm::dvec3, 8> result;
    for (unsigned i = 0; i < 8; ++i)
        result[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                     i & 4 ? box.max.z : box.min.z};
    return result;
}

std::vector<Bounds> boxes_around(const head::Model& model)
{
    const glm::vec3 extent = model.max - model.min;
    const float side = std::max({extent.x, extent.y, extent.z, 1e-6f}) / grid_cells;
    std::vector<std::optional<Bounds>> cells(grid_cells * grid_cells * grid_cells);
    for (const head::Primitive& primitive : model.primitives)
        for (std::uint32_t i = 0; i + 2 < primitive.index_count; i += 3) {
            const auto [a, b, c] = head::corners_of(model, primitive.first_index + i);
            const Bounds box{glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
            const glm::ivec3 cell = glm::clamp(glm::ivec3(((a + b + c) / 3.f - model.min) / side),
                                               glm::ivec3(0), glm::ivec3(grid_cells - 1));
            std::optional<Bounds>& held =
                cells[std::size_t((cell.z * grid_cells + cell.y) * grid_cells + cell.x)];
            held = held ? Bounds{glm::min(held->min, box.min), glm::max(held->max, box.max)} : box;
        }
    std::vector<Bounds> boxes;
    for (const std::optional<Bounds>& cell : cells)
        if (cell)
            boxes.push_back(*cell);
    return boxes;
}

std::vector<Bounds> boxes_in_view(std::span<const Bounds> boxes, const glm::mat4& clip_from_world)
{
    const glm::dmat4 clip(clip_from_world);
    std::vector<Bounds> seen;
    for (const Bounds& box : boxes) {
        unsigned outside = ~0u;
        for (const glm::dvec3& corner : corners(box))
            outside &= beyond(clip * glm::dvec4(corner, 1), glm::dvec2(1e-3));
        if (outside == 0)
            seen.push_back(box);
    }
    return seen;
}

bool may_show(std::span<const Triangle> triangles, const glm::mat4& clip_from_world,
              std::array<std::uint32_t, 2> size)
{
    const glm::dmat4 clip(clip_from_world);
    const glm::dvec2 half_size = 0.5 * glm::dvec2(size[0], size[1]);
    return std::ranges::any_of(triangles, [&](const Triangle& triangle) {
        std::array<glm::dvec4, 3> corners;
        unsigned outside = ~0u;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = clip * glm::dvec4(triangle.corners[k], 1);
            outside &= beyond(corners[k], 1.0 / half_size); // a pixel
        }
        return outside == 0 && (triangle.double_sided || turned_to_viewer(corners, half_size));
    });
}

} // namespace passes
