// The skin of a head on the device, spread out on its atlas (head/atlas.hpp): what is drawn onto the atlas,
// and what a camera draws from it. Both have the same vertices: head::Vertex with a place on the atlas.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/device.hpp"
#include "engine/gpu/mesh_buffer.hpp"
#include "head/atlas.hpp"
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
    std::vector<SkinShown> shown; // to a camera
    /// Wounded skin that has no place in a wound's tile, in rest_mesh: its light is computed in every pixel.
    std::vector<HeadPart> rest;
    std::shared_ptr<const gpu::MeshBuffer> rest_mesh;
    std::vector<std::uint32_t> materials;          // on the atlas, whole
    glm::uvec2 size{0};                            // units
    glm::uvec2 wounded_corner{0}, wounded_size{0}; // units: bounds of the wounds' tiles
    double texel_m = 0;                            // at scale 1
};

/// The materials whose light can be kept: opaque skin that is seen from one side.
std::vector<std::uint32_t> kept_materials(const head::Model& model);

/// `head`: of upload_head() with this model, without or with wounds. `atlas`: of kept_materials(model) with
/// these wounds' anchors. Null when it is empty.
std::shared_ptr<const Skin> upload_skin(const gpu::Device& device, const Head& head, const head::Model& model,
                                        const head::Atlas& atlas, std::span<const WoundReach> wounds);

/// The least scale of the atlas at which a texel is no wider than two pixels, and a wound's no wider than
/// one, where the camera is nearest to the head; when that would take too many texels the largest scale that
/// does not, if its texels are no wider than twice that; else none. `height`: of the whole picture, pixels.
std::optional<double> atlas_scale(const Skin& skin, std::span<const Bounds> head, const head::Camera& camera,
                                  std::uint32_t height);

} // namespace passes
