// The images, data and constants that a pass or a draw binds, by their names in the shaders.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
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

/// A copy of bytes with its hash. Copies share it: what stays the same for many frames need not be hashed in
/// each of them.
class Bytes
{
  public:
    explicit Bytes(std::span<const std::byte> value = {});
    template <std::ranges::contiguous_range Range>
    static Bytes of(const Range& values)
    {
        static_assert(std::is_trivially_copyable_v<std::ranges::range_value_t<Range>>);
        return Bytes(std::as_bytes(std::span(values)));
    }
    std::span<const std::byte> view() const { return *bytes_; }
    std::size_t size() const { return bytes_->size(); }
    std::uint64_t hash() const { return hash_; }

  private:
    std::shared_ptr<const std::vector<std::byte>> bytes_;
    std::uint64_t hash_;
};

using Constant = std::variant<bool, std::int32_t, std::uint32_t, float>;

/// Values by the names in the shader's source (for a block: its instance name, or its block name when it has
/// no instance name). A name that the shader does not declare is an error, and so is a shader binding without
/// a value. A second value for a name replaces the first.
class Bindings
{
  public:
    /// Samples an image. For an array of samplers in
    /// the shader, give one image for every element.
    void sample(std::string_view name, ImageId image, Sampler sampler = Sampler::LinearClamp);
    void sample(std::string_view name, std::span<const ImageId> images,
                Sampler sampler = Sampler::LinearClamp);
    void store(std::string_view name, ImageId image); // storage image, every texel written (compute only)
    /// Uniform block in scalar layout, as a C++ struct of shaders/shared/.
    template <typename T>
    void uniform(std::string_view name, const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        set(name, Bytes(std::as_bytes(std::span(&value, 1))), false);
    }
    /// Read-only storage buffer: a copy of an array of T in scalar layout. An empty array becomes one
    /// element of zeros.
    template <typename T>
    void buffer(std::string_view name, std::span<const T> values)
    {
        buffer(name, Bytes::of(values));
    }
    template <std::ranges::contiguous_range Range>
    void buffer(std::string_view name, const Range& values)
    {
        buffer(name, Bytes::of(values));
    }
    void buffer(std::string_view name, const Bytes& values) { set(name, values, true); }
    /// Specialisation constant (constant_id) by its name in the shader.
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
        Bytes bytes;
        bool storage;
    };
    std::vector<Sampled> sampled;
    std::vector<Stored> stored;
    std::vector<Data> data;
    std::map<std::string, Constant, std::less<>> constants;

  private:
    void set(std::string_view name, const Bytes& value, bool storage);
};

} // namespace graph
