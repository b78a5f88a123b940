#include "wound/synthetic/noise.hpp"

#include <algorithm>
#include <cmath>

namespace wound {

std::uint32_t hash(std::uint32_t seed, int x, int y)
{
    // Finaliser of MurmurHash3 (Appleby 2011) over a linear combination with odd constants.
    std::uint32_t h = seed * 0x9E3779B1u ^ std::uint32_t(x) * 0x85EBCA77u ^ std::uint32_t(y) * 0xC2B2AE3Du;
    h = (h ^ h >> 16) * 0x85EBCA6Bu;
    h = (h ^ h >> 13) * 0xC2B2AE35u;
    return h ^ h >> 16;
}

namespace {

float fade(float t)
{
    return t * t * t * (t * (6 * t - 15) + 10);
}

/// Dot product of the lattice point's random gradient with the vector from it.
float slope(std::uint32_t seed, int x, int y, float dx, float dy)
{
    const float angle = hash01(seed, x, y) * float(2 * CV_PI);
    return std::cos(angle) * dx + std::sin(angle) * dy;
}

} // namespace

Noise::Noise(std::uint32_t seed) : table_(std::size_t(size) * size)
{
    for (int cy = 0; cy < cells; ++cy)
        for (int cx = 0; cx < cells; ++cx) {
            std::array<cv::Point2f, 4> gradients;
            for (int corner = 0; corner < 4; ++corner) {
                const int gx = (cx + corner % 2) % cells, gy = (cy + corner / 2) % cells;
                gradients[corner] = {slope(seed, gx, gy, 1, 0), slope(seed, gx, gy, 0, 1)};
            }
            for (int ty = 0; ty < texels_per_cell; ++ty)
                for (int tx = 0; tx < texels_per_cell; ++tx) {
                    const float x = float(tx) / texels_per_cell, y = float(ty) / texels_per_cell;
                    const float u = fade(x), v = fade(y);
                    const float top = std::lerp(gradients[0].x * x + gradients[0].y * y,
                                                gradients[1].x * (x - 1) + gradients[1].y * y, u);
                    const float bottom = std::lerp(gradients[2].x * x + gradients[2].y * (y - 1),
                                                   gradients[3].x * (x - 1) + gradients[3].y * (y - 1), u);
                    table_[(cy * texels_per_cell + ty) * size + cx * texels_per_cell + tx] =
                        std::lerp(top, bottom, v) * 1.6f; // spreads the usual range to about -1..1
                }
        }
}

Cell cell_at(std::uint32_t seed, cv::Point2f p)
{
    const int cx = floor_to_int(p.x), cy = floor_to_int(p.y);
    float first = 8, second = 8; // squared distances; upper bounds for the points of the 3 x 3 cells
    std::uint32_t id = 0;
    for (int y = cy - 1; y <= cy + 1; ++y)
        for (int x = cx - 1; x <= cx + 1; ++x) {
            const std::uint32_t bits = hash(seed, x, y);
            const float dx = float(x) + float(bits & 0xFFFF) * 0x1p-16f - p.x;
            const float dy = float(y) + float(bits >> 16) * 0x1p-16f - p.y;
            const float distance = dx * dx + dy * dy;
            if (distance < first) {
                second = first;
                first = distance;
                id = bits;
            } else
                second = std::min(second, distance);
        }
    return {std::sqrt(first), std::sqrt(second), id};
}

} // namespace wound
