// What a pass or a draw gives to its shaders, by the names the shaders use.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace graph {

struct ImageId
{
    std::uint32_t index = ~0u;
    bool valid() const { return index != ~0u; }
    bool operator==(const ImageId&) const = default;
};

enum class Sampler : std::uint8_t
{
    LinearClamp,      // bilinear, no mips
    LinearRepeatMips, // trilinear, repeat
    LinearClampMips,  // trilinear, clamp
    NearestClamp,
};

using Constant = std::variant<bool, std::int32_t, std::uint32_t, float>;

/// What a shader is given, by the names its source uses (for a block: its instance name, or the block's own
/// name when it has no instance name). A name the shader does not know is an error; so is a binding of the
/// shader that is given no value. Giving a name twice replaces the first value.
class Bindings
{
  public:
    /// Samples an image. An array of samplers in the shader
    /// takes several images; every element must be given.
    void sample(std::string_view name, ImageId image, Sampler sampler = Sampler::LinearClamp);
    void sample(std::string_view name, std::span<const ImageId> images,
                Sampler sampler = Sampler::LinearClamp);
    void store(std::string_view name, ImageId image); // storage image, written whole (compute only)
    /// Uniform block in scalar layout: the C++ struct as it stands (shaders/shared/).
    template <typename T>
    void uniform(std::string_view name, const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(name, std::as_bytes(std::span(&value, 1)), false);
    }
    /// Read-only storage buffer holding an array of T in scalar layout; copied. The shader sees an empty
    /// array as one zeroed element.
    template <typename T>
    void buffer(std::string_view name, std::span<const T> values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(name, std::as_bytes(values), true);
    }
    template <std::ranges::contiguous_range Range>
    void buffer(std::string_view name, const Range& values)
    {
        buffer(name, std::span<const std::ranges::range_value_t<Range>>(values));
    }
    /// Specialisation constant (constant_id) by its name in the shader: bool, int, uint or float.
    void constant(std::string_view name, Constant value);

    struct Sampled
    {
        std::string name;
        std::vector<ImageId> images;
        Sampler sampler;
    };
    struct Stored
    {
        std::string name;
        ImageId image;
    };
    struct Data
    {
        std::string name;
        std::vector<std::byte> bytes;
        bool storage;
    };
    std::vector<Sampled> sampled;
    std::vector<Stored> stored;
    std::vector<Data> data;
    std::map<std::string, Constant, std::less<>> constants;

  private:
    void bytes(std::string_view name, std::span<const std::byte> value, bool storage);
};

} // namespace graph
