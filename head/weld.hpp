// Numbers a mesh's vertices so that equal ones have one number.
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace head {

/// A map key of bit patterns: only exactly equal vertices are joined.
template <std::size_t N>
struct Key
{
    std::array<std::uint32_t, N> bits;
    bool operator==(const Key&) const = default;
    struct Hash
    {
        std::size_t operator()(const Key& key) const
        {
            std::size_t hash = 0;
            for (std::uint32_t word : key.bits)
                hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
            return hash ^ hash >> 29;
        }
    };
};

inline std::uint32_t bits_of(float value)
{
    return std::bit_cast<std::uint32_t>(value + 0.0f); // -0 becomes +0
}

/// Assigns the same number to all vertices with equal keys.
template <std::size_t N, typename KeyOf>
std::vector<std::uint32_t> weld(std::size_t vertex_count, KeyOf&& key_of)
{
    std::unordered_map<Key<N>, std::uint32_t, typename Key<N>::Hash> classes;
    classes.reserve(vertex_count);
    std::vector<std::uint32_t> class_of(vertex_count);
    for (std::size_t v = 0; v < vertex_count; ++v)
        class_of[v] =
            classes.try_emplace(key_of(v), static_cast<std::uint32_t>(classes.size())).first->second;
    return class_of;
}

} // namespace head
