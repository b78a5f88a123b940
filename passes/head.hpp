// A head on the device: its mesh, textures and parts.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "engine/gpu/device.hpp"
#include "engine/gpu/mesh_buffer.hpp"
#include "engine/gpu/texture.hpp"
#include "head/materials.hpp"
#include "head/model.hpp"
#include "head/placement.hpp"
#include "passes/in_view.hpp"

namespace passes {

/// Where a wound's images can show.
struct WoundReach
{
    head::Anchor anchor;
    glm::dvec2 low{-1}, high{1}; // of the patch: x along `right`, y along `down`, -1..1 all of it
    /// May keep too much. first: of the triangle's indices.
    bool holds(const head::Model& model, std::size_t first) const;
    bool operator==(const WoundReach&) const = default;
};

/// Wounds by their places in with_wounds(), ascending.
using WoundSet = std::vector<std::uint32_t>;

/// Of more than shared::WOUNDS_HERE wounds those whose middles are nearest to the point, in half widths of
/// their patches: so many can be drawn in one place.
WoundSet drawn_near(WoundSet wounds, const glm::dvec3& point, std::span<const WoundReach> reaches);

/// The wounds that can show on the triangle, of those that may be too many drawn_near() its middle. first: of
/// the triangle's indices.
WoundSet wounds_on(const head::Model& model, std::size_t first, std::span<const WoundReach> wounds);

struct HeadPart
{
    head::Surface surface = head::Surface::Skin;
    std::uint32_t first_index = 0, index_count = 0, material = 0; // material: of the model
    bool blend = false, double_sided = false;
    WoundSet wounds; // of the skin's part: the wounds that can show on it, at most shared::WOUNDS_HERE
    const gpu::Texture *albedo = nullptr, *normal = nullptr,
                       *occlusion = nullptr; // owned by Head::textures; never null after upload_head()
    glm::vec4 albedo_factor{1.0f};
    float normal_scale = 1.0f;
};

struct Head
{
    std::vector<HeadPart> parts; // opaque first, then blended
    std::shared_ptr<const gpu::MeshBuffer> mesh;
    std::vector<head::Primitive> casters; // shadow casters: the opaque primitives, in caster_mesh
    std::shared_ptr<const gpu::MeshBuffer> caster_mesh;
    std::vector<std::shared_ptr<const gpu::Texture>> textures;
    const gpu::Texture* white = nullptr;        // one texel
    glm::vec3 min{0.0f}, max{0.0f};             // metres
    std::vector<Bounds> boxes;                  // boxes_around() the model
    std::vector<std::vector<Triangle>> wounded; // by wound: the skin on which it can show
    std::size_t crowded = 0; // triangles that more than shared::WOUNDS_HERE wounds reach: they show so many
};

gpu::MeshBuffer upload_mesh(const gpu::Device& device, std::span<const head::Vertex> vertices,
                            std::span<const std::uint32_t> indices, const std::string& name);

/// Uploads the model; each of its primitives becomes one part, not wounded.
Head upload_head(const gpu::Device& device, const head::Model& model);

/// Returns a copy of `head` with separate parts for the skin triangles of each set of wounds that can show on
/// them. It shares vertices, textures and shadow casters with `head`, which upload_head() must have made from
/// `model`.
Head with_wounds(const gpu::Device& device, const Head& head, const head::Model& model,
                 std::span<const WoundReach> wounds);

} // namespace passes
