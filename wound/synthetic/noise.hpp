// Seeded noise for generated tissue. The same seed gives the same values on every machine, because a hash
// replaces the standard library's generators.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace wound {

/// 32-bit hash of (seed, x, y).
std::uint32_t hash(std::uint32_t seed, int x, int y);

/// hash() as a fraction in [0,1).
inline float hash01(std::uint32_t seed, int x, int y)
{
    return float(hash(seed, x, y) >> 8) * 0x1p-24f;
}

/// Like std::floor, which is a function call when the compiler may not assume SSE4.1.
inline int floor_to_int(float x)
{
    const int truncated = int(x);
    return truncated - (x < float(truncated));
}

/// One octave of gradient noise (Perlin 2002), stored in a periodic table that is sampled bilinearly.
class Noise
{
  public:
    explicit Noise(std::uint32_t seed);

    /// About -1..1; features are one unit wide, the period is 32 units in x and y.
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

    /// Weighted mean of `octaves` octaves, each half as wide and `gain` times as strong as the previous one.
    float sum(cv::Point2f p, int octaves, float gain = .5f) const
    {
        float total = 0, weight = 1, weights = 0;
        for (int octave = 0; octave < octaves; ++octave) {
            total += weight * at(p);
            weights += weight;
            weight *= gain;
            // Rotating and shifting each octave keeps the lattices from aligning.
            p = {1.6f * p.x - 1.2f * p.y + 17.3f, 1.2f * p.x + 1.6f * p.y + 5.7f};
        }
        return total / weights;
    }

  private:
    static constexpr int cells = 32, texels_per_cell = 8, size = cells * texels_per_cell;
    std::vector<float> table_; // size x size
};

/// Worley 1996: distances to the nearest and second nearest of points scattered one per unit cell, and the
/// nearest point's hash.
struct Cell
{
    float nearest, second;
    std::uint32_t id;
};
Cell cell_at(std::uint32_t seed, cv::Point2f p);

} // namespace wound
