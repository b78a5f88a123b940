// The render graph as a pass author sees it: declare images and passes for one frame; Executor::run schedules and
// executes them. Nothing here calls Vulkan; barriers, layouts, labels and timestamps are not the author's business.
//
// A pass's key is computed from what it declares (shader, constants, uniforms, buffers, draws), so it cannot be
// forgotten. A pass whose key and inputs are those of its last run is skipped; one whose outputs nobody needs is culled.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>
#include <volk.h>

namespace engine {

class Texture;    // an image uploaded from the CPU, with its mip levels
class MeshBuffer; // vertices and indices on the device

struct ImageId
{
    std::uint32_t index = ~0u;
    bool valid() const { return index != ~0u; }
    bool operator==(const ImageId&) const = default;
};
struct ReadbackId
{
    std::uint32_t index = ~0u;
};

struct ImageDesc
{
    std::uint32_t width = 0, height = 0; // texels
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t samples = 1; // 1 or 4
    bool operator==(const ImageDesc&) const = default;
};

enum class Sampler : std::uint8_t
{
    LinearClamp, // bilinear, no mips
    LinearRepeatMips, // trilinear, repeat
    LinearClampMips,  // trilinear, clamp
    NearestClamp,
};

/// What a shader is given, by the names its source uses. A name the shader does not know is an error at declaration;
/// a binding of the shader that is given no value is an error too.
class Bindings
{
  public:
    /// Samples an image. An array of samplers in the shader takes several images; every element must be given.
    void sample(std::string_view name, ImageId image, Sampler sampler = Sampler::LinearClamp);
    void sample(std::string_view name, std::span<const ImageId> images, Sampler sampler = Sampler::LinearClamp);
    void store(std::string_view name, ImageId image); // storage image, written whole (compute only)
    /// Uniform block in scalar layout: the C++ struct as it stands (shaders/shared/).
    template <typename T>
    void uniform(std::string_view name, const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(name, std::as_bytes(std::span(&value, 1)), false);
    }
    /// Read-only storage buffer holding an array of T in scalar layout; copied.
    template <typename T>
    void buffer(std::string_view name, std::span<const T> values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(name, std::as_bytes(values), true);
    }
    /// Specialisation constant (constant_id) by its name in the shader: bool, int, uint or float.
    void constant(std::string_view name, std::variant<bool, std::int32_t, std::uint32_t, float> value);

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
    std::map<std::string, std::uint32_t, std::less<>> constants; // bit patterns

  private:
    void bytes(std::string_view name, std::span<const std::byte> value, bool storage);
};

class ComputePass : public Bindings
{
  public:
    /// Number of invocations wanted; the group count follows from the shader's local size.
    void dispatch(std::uint32_t width, std::uint32_t height);
    std::string name, shader;
    std::uint32_t width = 0, height = 0;
};

/// One draw. Bindings not given here are looked up in the pass.
class Draw : public Bindings
{
  public:
    std::string shader;               // stem: "forward" means forward.vert and forward.frag
    const MeshBuffer* mesh = nullptr; // null: `index_count` vertices without buffers (full-screen triangle: 3)
    std::uint32_t first_index = 0, index_count = 0;
    bool cull_back_faces = true;
    bool blend = false;       // source alpha over
    bool depth_test = true;   // used when the pass has a depth image
    bool depth_write = true;
};

class RasterPass : public Bindings
{
  public:
    /// Colour target, cleared to `clear` first. With `resolve`, `image` is multisampled and is resolved into it.
    void color(ImageId image, std::array<float, 4> clear, ImageId resolve = {});
    void depth(ImageId image, float clear = 1.0f); // test: less or equal
    Draw& draw(std::string_view shader);
    /// The picture itself: run it each frame even when nothing changed.
    void every_frame() { always = true; }

    struct ColorTarget
    {
        ImageId image, resolve;
        std::array<float, 4> clear;
    };
    std::string name;
    std::vector<ColorTarget> colors;
    ImageId depth_image;
    float depth_clear = 1.0f;
    std::vector<Draw> draws;
    bool always = false;
};

/// The declaration of one frame. References returned by compute() and raster() stay valid while the Graph lives.
class Graph
{
  public:
    /// An image the graph owns. Its contents last from frame to frame under its name, so that its writer can be skipped.
    ImageId image(std::string_view name, const ImageDesc& desc);
    /// An image made outside the graph, ready to be sampled.
    ImageId import(std::string_view name, const Texture& texture);
    ComputePass& compute(std::string_view name, std::string_view shader);
    RasterPass& raster(std::string_view name);
    /// Copies an image to the host at the end of the frame. This is what makes a pass needed: whatever leads to no
    /// readback and no presentation is culled.
    ReadbackId readback(std::string_view name, ImageId image);
    // ... the declaration's storage, read by schedule() and Executor, is completed in the implementation.
};

} // namespace engine
