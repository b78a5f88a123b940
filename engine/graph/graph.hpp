// The render graph as a pass author sees it: declare images and passes for one
// frame; Executor::run schedules and executes them. Nothing here calls Vulkan;
// the executor adds barriers, layouts, labels and timestamps.
//
// The key of a pass is computed from its declaration (shader, constants,
// uniforms, buffers, draws). A pass is skipped when its key and inputs equal
// those of its last run, and culled when nothing needs its outputs.
//
// Every image has exactly one writer, which writes all of it; passes may be declared in any order. A pass
// that runs because of inputs whose changes it has confined to a region writes that region only: the rest
// stands.
#pragma once
#include "engine/graph/bindings.hpp"
#include "engine/graph/mesh.hpp"
#include "engine/graph/region.hpp"

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

/// An image made outside the graph, always in the layout for sampling;
/// `content` identifies its contents and is unique in the process.
struct ExternalImage
{
    ImageDesc desc;
    VkImageView view = VK_NULL_HANDLE;
    std::uint64_t content = 0;
};

/// What of a pass's images a change of an input can touch; without a word about it: everything. The images
/// that the pass writes must have one size. A wrong region leaves outdated texels: Measuring::check_regions
/// finds them.
class Reach
{
  public:
    /// A change of a uniform block or buffer, of the pass or of its draws, touches no texel outside `region`;
    /// neither does a change from an earlier frame's value outside the regions of both frames.
    void confine(std::string_view block, const Region& region)
    {
        confined.push_back({std::string(block), {}, region});
    }
    /// The same of a sampled image's contents.
    void confine(ImageId image, const Region& region) { confined.push_back({{}, image, region}); }
    /// The same of a change that leaves all of the image but `source` as it was.
    void confine(ImageId image, const Region& source, const Region& region)
    {
        confined.push_back({{}, image, region, source});
    }
    /// Every texel depends on the texel of `image` at the same place, and on no other of it.
    void in_place(ImageId image) { confined.push_back({{}, image, std::nullopt}); }

    struct Confined
    {
        std::string block; // empty: `image`
        ImageId image;
        std::optional<Region> region; // none: in place
        std::optional<Region> source; // none: wherever the image changes
    };
    std::vector<Confined> confined;
};

class ComputePass : public Bindings, public Reach
{
  public:
    /// Number of invocations; the group count follows from the shader's local size.
    void dispatch(std::uint32_t invocations_x, std::uint32_t invocations_y);
    /// Runs the pass, and the passes that sample its images, in every frame.
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
    const Mesh* mesh = nullptr; // null: `index_count` vertices without attributes (3: full screen)
    std::uint32_t first_index = 0, index_count = 0; // with a mesh, count 0: up to its last index
    bool cull_back_faces = true; // meshes only; front faces are counter-clockwise in the picture
    bool blend = false;          // source alpha over
    bool depth_test = true;      // used when the pass has a depth image
    bool depth_write = true;
};

/// Clip space is Vulkan's: y points down, depth runs from 0 to 1.
class RasterPass : public Bindings, public Reach
{
  public:
    /// Colour target, cleared to `clear` first. With `resolve`, `image`
    /// must be multisampled; the pass resolves it into `resolve`.
    void color(ImageId image, std::array<float, 4> clear, ImageId resolve = {});
    void depth(ImageId image, float clear = 1.0f); // test: less or equal
    Draw& draw(std::string_view shader);
    /// Runs the pass in every frame even when nothing changed.
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
    std::deque<Draw> draws; // a deque, so that references stay valid
    bool always = false;
};

using Pass = std::variant<ComputePass, RasterPass>;

/// The declaration of one frame. References returned by
/// compute() and raster() stay valid while the Graph lives.
class Graph
{
  public:
    /// An image the graph owns. Its contents are kept between frames
    /// under its name, so that its writer can be skipped.
    ImageId image(std::string_view name, const ImageDesc& desc);
    /// An image made outside the graph. It must outlive the frame. Again with the same name and
    /// contents: the same image.
    ImageId import(std::string_view name, const ExternalImage& external);
    /// Imports an object that has external(), such as gpu::Texture.
    template <typename Texture>
    requires requires(const Texture& texture) { texture.external(); }
    ImageId import(std::string_view name, const Texture& texture) { return import(name, texture.external()); }
    ComputePass& compute(std::string_view name, std::string_view shader);
    RasterPass& raster(std::string_view name);
    /// Copies an image to the host at the end of the frame. A pass is culled unless a readback or a presented
    /// image depends on it.
    ReadbackId readback(std::string_view name, ImageId image);
    /// Leaves an image in the transfer source layout after the
    /// frame, for a copy to a window: Executor::presented().
    void present(ImageId image);
    /// Prefix of the names of all later images and passes, so that the same passes can be declared twice.
    void prefix(std::string_view names) { name_prefix_ = names; }
    /// Keeps a resource that the frame reads (a texture or a mesh) alive until the frame is finished.
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
