// Triangles in the plane: which texels they cover, and whether they overlap. For the skin atlas.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

namespace head {

using FlatTriangle = std::array<glm::dvec2, 3>;

inline double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}
inline double signed_area(const FlatTriangle& t)
{
    return cross(t[1] - t[0], t[2] - t[0]) / 2;
}

struct Box2
{
    glm::dvec2 low{1e300}, high{-1e300};
    void add(const glm::dvec2& p)
    {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

/// A value and its weight.
struct Weighted
{
    double value = 0, weight = 0;
};
/// The value below which the share `q`, 0..1, of the weight lies; 0 of nothing.
double weighted_quantile(std::vector<Weighted> values, double q);

/// A set of triangles that do not overlap, in a grid over `box`. Each triangle takes a bounded number of
/// steps: sets of extremely uneven triangles are refused in part.
class FlatLayer
{
  public:
    FlatLayer(const Box2& box, std::size_t most_triangles);

    /// Adds the triangle and returns true, unless it overlaps one in the set, has no area or takes too many
    /// steps. Triangles that only touch do not overlap.
    bool add(FlatTriangle triangle);

  private:
    struct Link
    {
        std::uint32_t triangle, next;
    };
    glm::ivec2 cell(const glm::dvec2& at) const;

    glm::dvec2 low_, cells_per_length_;
    glm::ivec2 cells_{1};
    double slack_; // by which triangles that touch may overlap
    std::size_t steps_left_, links_left_;
    std::vector<std::uint32_t> first_; // of each cell: its first link
    std::vector<Link> links_;
    std::vector<FlatTriangle> triangles_;
    std::vector<std::uint32_t> tested_; // by triangle: for which call of add()
    std::uint32_t calls_ = 0;
};

/// Calls use(row, begin, end) for each row of texels whose centres are in the triangle, as long as it returns
/// true. `at` in texels, in 0..size, up to 4096. A centre on the edge of two triangles belongs to one of
/// them.
template <typename Use>
void for_each_texel_row(const std::array<glm::dvec2, 3>& at, const glm::ivec2& size, const Use& use)
{
    using Fixed = std::int64_t; // exact: 256 per texel
    const auto ceil_ratio = [](Fixed a, Fixed b) { return a >= 0 ? (a + b - 1) / b : -(-a / b); }; // b > 0
    std::array<glm::i64vec2, 3> p;
    for (int k = 0; k < 3; ++k)
        p[k] = {std::llround(at[k].x * 256), std::llround(at[k].y * 256)};
    const Fixed area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (area == 0)
        return;
    if (area < 0)
        std::swap(p[1], p[2]);
    const Fixed top = std::min({p[0].y, p[1].y, p[2].y}), bottom = std::max({p[0].y, p[1].y, p[2].y});
    const Fixed last = std::min<Fixed>(ceil_ratio(bottom - 128, 256), size.y - 1);
    for (Fixed row = std::max<Fixed>(ceil_ratio(top - 128, 256), 0); row <= last; ++row) {
        const Fixed y = 256 * row + 128;
        Fixed begin = 0, end = size.x;
        for (int k = 0; k < 3; ++k)
        { // inside is where dx (y - p.y) - dy (x - p.x) > 0; = 0 at the left and top
            const glm::i64vec2& from = p[k];
            const glm::i64vec2 d = p[(k + 1) % 3] - from;
            const Fixed c = d.x * (y - from.y) + d.y * from.x;
            if (d.y > 0)
                end = std::min(end, ceil_ratio(c - 128 * d.y, 256 * d.y));
            else if (d.y < 0)
                begin = std::max(begin, ceil_ratio(128 * d.y - c, -256 * d.y));
            else if (d.x > 0 ? c < 0 : c <= 0)
                end = 0;
        }
        if (begin < end && !use(int(row), int(begin), int(end)))
            return;
    }
}

} // namespace head
