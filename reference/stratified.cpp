#include "reference/stratified.hpp"

#include "reference/random.hpp"

namespace reference {
namespace {

std::uint32_t reversed(std::uint32_t x)
{
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    return x << 16 | x >> 16;
}

/// Permutes so that a bit depends on those above it alone, in numbers whose bits are reversed.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed)
{
    x = reversed(x) + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversed(x);
}

/// Sobol's second dimension: each direction number is the one before, xored with its half.
std::uint32_t sobol_second(std::uint32_t index)
{
    std::uint32_t x = 0;
    for (std::uint32_t direction = 0x80000000u; index != 0; index >>= 1, direction ^= direction >> 1)
        if (index & 1)
            x ^= direction;
    return x;
}

} // namespace

std::array<double, 2> stratified(std::uint32_t index, std::uint64_t scramble)
{
    const auto part = [&](std::uint64_t which) { return std::uint32_t(Random::mixed(scramble + which)); };
    const std::uint32_t shuffled = scrambled(index, part(1));
    return {scrambled(reversed(shuffled), part(2)) * 0x1p-32,
            scrambled(sobol_second(shuffled), part(3)) * 0x1p-32};
}

} // namespace reference
