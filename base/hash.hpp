// A 64-bit hash of what a pass declares: fast, the same in every run, not cryptographic.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace base {

class Hash
{
  public:
    /// Fundamental types and enums only: a struct may have padding.
    template <typename T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T> Hash& add(T value)
    {
        std::uint64_t word = 0;
        std::memcpy(&word, &value, sizeof value);
        return mix(word);
    }

    Hash& add(std::span<const std::byte> bytes)
    {
        mix(bytes.size()); // so that ("ab", "c") and ("a", "bc") differ
        for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data(), 8);
            mix(word);
        }
        std::uint64_t rest = 0;
        if (!bytes.empty())
            std::memcpy(&rest, bytes.data(), bytes.size());
        return mix(rest);
    }

    Hash& add(std::string_view text) { return add(std::as_bytes(std::span(text.data(), text.size()))); }

    /// Never 0, because 0 means "contents undefined".
    std::uint64_t value() const { return state ? state : 1; }

  private:
    /// The finaliser of MurmurHash3 (Austin Appleby) over the running state and the next word.
    Hash& mix(std::uint64_t word)
    {
        state = (std::rotl(state, 27) ^ word) * 0x9e3779b97f4a7c15u + 0x52dce729u;
        state = (state ^ (state >> 33)) * 0xff51afd7ed558ccdu;
        state = (state ^ (state >> 33)) * 0xc4ceb9fe1a85ec53u;
        state ^= state >> 33;
        return *this;
    }

    std::uint64_t state = 0x243f6a8885a308d3u;
};

} // namespace base
