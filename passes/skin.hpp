// The skin of a head on the device, spread out on its atlas (head/atlas.hpp): what is drawn onto the atlas,
// and what a camera draws from it. Both have the same vertices: head::Vertex with a place on the atlas.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/color.hpp"
#include "engine/gpu/device.hpp"
#include "engine/gpu/mesh_buffer.hpp"
#include "engine/graph/region.hpp"
#include "head/atlas_surface.hpp"
#include "head/camera.hpp"
#include "passes/head.hpp"

namespace passes {

/// A piece of the skin in a tile of the atlas.
struct SkinDraw
{
    std::uint32_t first_index = 0, index_count = 0;
    std::uint32_t material = 0;    // of the model
    WoundSet wounds;               // HeadPart::wounds
    glm::uvec2 corner{0}, size{0}; // units, of the tile
};

/// All of a material, or what of it wounds can show on.
struct SkinShown
{
    std::uint32_t first_index = 0, index_count = 0;
    std::uint32_t material = 0; // of the model
    bool wounded = false;
};

struct Skin
{
    std::shared_ptr<const gpu::MeshBuffer> mesh;
    std::vector<SkinDraw> spread; // onto the atlas, in this order
    std::vector<SkinShown> shown; // to a camera, with the light that is kept on it
    std::vector<SkinDraw> lit;    // the same, where light is computed in every pixel
    /// Of `lit`, what is not shown: wounded skin that has no place in a wound's tile. Its place is in a
    /// material's, where the light is that of unhurt skin.
    std::vector<SkinDraw> rest;
    std::shared_ptr<const gpu::MeshBuffer> surface_mesh; // of head::SurfaceVertex
    std::vector<head::SurfacePiece> surface;             // in the order in which they are to be drawn
    std::vector<std::uint32_t> materials;                // on the atlas, whole
    glm::uvec2 size{0};                                  // units
    glm::uvec2 wounded_corner{0}, wounded_size{0};       // units: bounds of the wounds' tiles
    double texel_m = 0;                                  // at scale 1
};

/// The materials whose light can be kept: opaque skin that is seen from one side.
std::vector<std::uint32_t> kept_materials(const head::Model& model);

/// `atlas`: of kept_materials(model) with these wounds' anchors. `surface`: of its tiles of materials, with
/// skirts. Null when it is empty.
std::shared_ptr<const Skin> upload_skin(const gpu::Device& device, const head::Model& model,
                                        const head::Atlas& atlas, const head::AtlasSurface& surface,
                                        std::span<const WoundReach> wounds);

/// The width of a pixel on the skin where the camera is nearest to it, m. `height`: of the whole picture,
/// pixels.
double pixel_m(std::span<const Bounds> head, const head::Camera& camera, std::uint32_t height);

/// The least scale of the atlas at which a texel is no wider than two pixels, and a wound's no wider than
/// one; when that would take too many texels the largest scale that does not, if its texels are no wider than
/// twice that; else none.
std::optional<double> atlas_scale(const Skin& skin, double pixel_m);

/// A region of an image on the atlas in an image at `ratio` times its scale and of this size; larger on each
/// side by `margin` texels of that image.
graph::Region scaled(const graph::Region& region, double ratio, double margin, const glm::uvec2& size);

/// The scale of the atlas on which light spreads through tissue of this scattering length: a texel is about
/// as wide as light spreads, or as a pixel if that is wider.
double diffusion_scale(const Skin& skin, const base::Color& scattering_length_mm, double pixel_m);

} // namespace passes
