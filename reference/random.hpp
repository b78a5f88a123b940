// Random numbers that depend on nothing but what they are for: the seed, the pixel and the number of its
// sample. So a picture does not depend on which thread made which part of it, nor on where it was
// interrupted.
#pragma once
#include <cstdint>

namespace reference {

/// Counter-based: the n-th number is a hash of the key plus n steps (Steele, Lea & Flood 2014, "Fast
/// splittable pseudorandom number generators": SplitMix64).
class Random
{
  public:
    Random(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample)
        : state_(mixed(mixed(mixed(seed + golden) ^ pixel) + golden * (sample + 1)))
    {
    }

    /// Uniform in [0, 1).
    double operator()() { return double(bits() >> 11) * 0x1p-53; }
    std::uint64_t bits() { return mixed(state_ += golden); }

    static constexpr std::uint64_t mixed(std::uint64_t z)
    {
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }

  private:
    static constexpr std::uint64_t golden = 0x9E3779B97F4A7C15u;
    std::uint64_t state_;
};

} // namespace reference
