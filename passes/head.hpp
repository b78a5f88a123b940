// A head on the device: its mesh, its materials' textures, and what kind of surface each of its parts is.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "engine/device.hpp"
#include "engine/mesh_buffer.hpp"
#include "engine/model.hpp"
#include "engine/texture.hpp"
#include "passes/placement.hpp"

namespace passes {

enum class Surface : std::uint8_t
{
    Skin, // the material that covers most of the head; takes wounds and translucency
    Eye,  // smooth and wet: a narrow highlight
    Hair, // brows and lashes: blended, no highlight, no shadow
    Other // mouth, clothes: no highlight
};

struct HeadPart
{
    Surface surface = Surface::Skin;
    std::uint32_t first_index = 0, index_count = 0;
    bool blend = false, double_sided = false;
    bool wounded = false; // skin that some wound's patch reaches
    const engine::Texture *albedo = nullptr, *normal = nullptr,
                          *occlusion = nullptr; // owned by the head, never null
    glm::vec4 albedo_factor{1.0f};
    float normal_scale = 1.0f;
};

struct Head
{
    std::vector<HeadPart> parts; // opaque first, then blended
    std::shared_ptr<const engine::MeshBuffer> mesh;
    std::vector<engine::Primitive> casters; // what casts a shadow, of the mesh as it came
    std::shared_ptr<const engine::MeshBuffer> caster_mesh;
    std::vector<std::shared_ptr<const engine::Texture>> textures;
    const engine::Texture* white = nullptr; // one texel
    glm::vec3 min{0.0f}, max{0.0f};         // metres
};

/// The material that covers the largest area: the skin.
std::uint32_t skin_material(const engine::Model& model);

/// Uploads the model, one part for each of its primitives, none of them wounded.
Head upload_head(const engine::Device& device, const engine::Model& model);

/// The same head on the device, with the skin triangles that an anchor's patch reaches in parts of their own.
/// Vertices, textures and what casts the shadow are shared with `head`, which upload_head made of `model`.
Head with_wounds(const engine::Device& device, const Head& head, const engine::Model& model,
                 std::span<const Anchor> anchors);

} // namespace passes
