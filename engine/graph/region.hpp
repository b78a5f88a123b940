// Rectangles of texels: what of an image a pass writes again when only some of its inputs have changed.
#pragma once
#include <algorithm>
#include <cstdint>

namespace graph {

/// By default empty.
struct Region
{
    std::uint32_t x = 0, y = 0, width = 0, height = 0; // texels
    bool empty() const { return width == 0 || height == 0; }
    std::uint64_t texels() const { return std::uint64_t{width} * height; }
    bool operator==(const Region&) const = default;
};

/// The smallest region that holds both.
inline Region bounds(const Region& a, const Region& b)
{
    if (a.empty() || b.empty())
        return a.empty() ? b : a;
    const std::uint32_t x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

inline bool holds(const Region& outer, const Region& inner)
{
    return bounds(outer, inner) == outer;
}

} // namespace graph
