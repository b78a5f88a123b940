// Places within a pixel that fill it evenly however many of them are taken: two dimensions of Sobol's
// sequence, scrambled by Owen's method.
#pragma once
#include <array>
#include <cstdint>

namespace reference {

/// The `index`-th point of the square 0..1 x 0..1; each `scramble` is another such sequence. Burley 2020,
/// "Practical hash-based Owen scrambling", J. Computer Graphics Techniques 9(4), with the hash of Laine &
/// Karras 2011.
std::array<double, 2> stratified(std::uint32_t index, std::uint64_t scramble);

} // namespace reference
