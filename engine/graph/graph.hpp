// The render graph as a pass author sees it: declare images and passes for one
// frame; Executor::run schedules and executes them. Nothing here calls Vulkan;
// barriers, layouts, labels and timestamps are not the author's business.
//
// A pass's key is computed from what it declares (shader, constants, uniforms,
// buffers, draws), so it cannot be forgotten. A pass whose key and inputs are
// those of its last run is skipped; one whose outputs nobody needs is culled.
//
// Every image has exactly one writer, which writes all of it; passes may be declared in any order.
#pragma once
#include "engine/graph/bindings.hpp"
#include "engine/graph/mesh.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>
#include <volk.h>

namespace graph {

struct ReadbackId
{
    std::uint32_t index = ~0u;
    bool valid() const { return index != ~0u; }
};

struct ImageDesc
{
    std::uint32_t width = 0, height = 0; // texels
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t samples = 1; // 1 or 4
    bool operator==(const ImageDesc&) const = default;
};

/// An image made outside the graph, always ready to be sampled;
/// `content` names what is in it and is never used twice.
struct ExternalImage
{
    ImageDesc desc;
    VkImageView view = VK_NULL_HANDLE;
    std::uint64_t content = 0;
};

class ComputePass : public Bindings
{
  public:
    /// Number of invocations wanted; the group count follows from the shader's local size.
    void dispatch(std::uint32_t invocations_x, std::uint32_t invocations_y);
    /// Run it each frame even when nothing changed; what samples it follows.
    void every_frame() { always = true; }

    std::string name, shader; // shader: file name, "wound_texture.comp"
    std::uint32_t width = 0, height = 0;
    bool always = false;
};

/// One draw. Bindings not given here are looked up in the pass.
class Draw : public Bindings
{
  public:
    std::string shader;         // stem: "forward" means forward.vert and forward.frag
    const Mesh* mesh = nullptr; // null: `index_count` vertices out of nothing (full-screen triangle: 3)
    std::uint32_t first_index = 0, index_count = 0; // with a mesh, index_count 0 means up to its last index
    bool cull_back_faces = true; // of a mesh; the front is counter-clockwise as seen in the picture
    bool blend = false;          // source alpha over
    bool depth_test = true;      // used when the pass has a depth image
    bool depth_write = true;
};

/// Clip space is Vulkan's: y points down, depth runs from 0 to 1.
class RasterPass : public Bindings
{
  public:
    /// Colour target, cleared to `clear` first. With `resolve`,
    /// `image` is multisampled and is resolved into it.
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
    std::deque<Draw> draws; // references to them stay valid
    bool always = false;
};

using Pass = std::variant<ComputePass, RasterPass>;

/// The declaration of one frame. References returned by
/// compute() and raster() stay valid while the Graph lives.
class Graph
{
  public:
    /// An image the graph owns. Its contents last from frame to
    /// frame under its name, so that its writer can be skipped.
    ImageId image(std::string_view name, const ImageDesc& desc);
    /// An image made outside the graph, ready to be sampled. It must outlive the frame.
    ImageId import(std::string_view name, const ExternalImage& external);
    /// Of whatever hands out its ExternalImage: a texture.
    template <typename Texture>
    requires requires(const Texture& texture) { texture.external(); }
    ImageId import(std::string_view name, const Texture& texture) { return import(name, texture.external()); }
    ComputePass& compute(std::string_view name, std::string_view shader);
    RasterPass& raster(std::string_view name);
    /// Copies an image to the host at the end of the frame. This is what makes a pass needed: whatever leads
    /// to no readback and no presentation is culled.
    ReadbackId readback(std::string_view name, ImageId image);
    /// Leaves an image ready to be copied from (to a window,
    /// for instance) after the frame: Executor::presented().
    void present(ImageId image);
    /// Put before the names of what is declared from now on, so that one recipe can be declared twice.
    void prefix(std::string_view names) { name_prefix_ = names; }
    /// Something the frame reads on the device, a texture or a mesh, lives until the frame is finished,
    /// even if its owner lets go of it before.
    void keep(std::shared_ptr<const void> used) { kept.push_back(std::move(used)); }

    struct Image
    {
        std::string name;
        ImageDesc desc;
        std::optional<ExternalImage> external;
    };
    struct Readback
    {
        std::string name;
        ImageId image;
    };
    std::vector<Image> images;
    std::deque<Pass> passes;
    std::vector<Readback> readbacks;
    std::vector<ImageId> presented;
    std::vector<std::shared_ptr<const void>> kept;

  private:
    std::string name_prefix_;
};

const std::string& name_of(const Pass& pass);

} // namespace graph
