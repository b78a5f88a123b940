// Seeded noise for generated tissue. The same seed gives the same values on every machine: integers come from
// a hash, and no library generator is used.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace wound {

/// Well-mixed 32 bits of (seed, x, y).
std::uint32_t hash(std::uint32_t seed, int x, int y);

/// hash() as a fraction in [0,1).
inline float hash01(std::uint32_t seed, int x, int y)
{
    return float(hash(seed, x, y) >> 8) * 0x1p-24f;
}

/// Like std::floor, which is a call where the compiler may not assume SSE4.1.
inline int floor_to_int(float x)
{
    const int truncated = int(x);
    return truncated - (x < float(truncated));
}

/// One octave of gradient noise (Perlin 2002) kept as a periodic table, so that a look-up costs one bilinear
/// fetch.
class Noise
{
  public:
    explicit Noise(std::uint32_t seed);

    /// About -1..1, features one unit wide, period 32 units in x and y.
    float at(cv::Point2f p) const
    {
        const float x = p.x * texels_per_cell, y = p.y * texels_per_cell;
        const int ix = floor_to_int(x), iy = floor_to_int(y);
        const int x0 = ix & (size - 1), x1 = (ix + 1) & (size - 1);
        const float* upper = &table_[std::size_t(iy & (size - 1)) * size];
        const float* lower = &table_[std::size_t((iy + 1) & (size - 1)) * size];
        const float u = x - float(ix), v = y - float(iy);
        const float top = upper[x0] + u * (upper[x1] - upper[x0]);
        const float bottom = lower[x0] + u * (lower[x1] - lower[x0]);
        return top + v * (bottom - top);
    }

    /// Sum of `octaves` octaves, each half as wide and `gain` times as strong as the one before; divided by
    /// the sum of weights.
    float sum(cv::Point2f p, int octaves, float gain = .5f) const
    {
        float total = 0, weight = 1, weights = 0;
        for (int octave = 0; octave < octaves; ++octave) {
            total += weight * at(p);
            weights += weight;
            weight *= gain;
            // Turning and shifting each octave keeps the lattices from lining up.
            p = {1.6f * p.x - 1.2f * p.y + 17.3f, 1.2f * p.x + 1.6f * p.y + 5.7f};
        }
        return total / weights;
    }

  private:
    static constexpr int cells = 32, texels_per_cell = 8, size = cells * texels_per_cell;
    std::vector<float> table_; // size x size
};

/// Worley 1996: distances to the nearest and second nearest of points scattered one per unit cell, and a
/// number that is the nearest point's own.
struct Cell
{
    float nearest, second;
    std::uint32_t id;
};
Cell cell_at(std::uint32_t seed, cv::Point2f p);

} // namespace wound
