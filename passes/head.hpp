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
    std::vector<HeadPart> parts;            // opaque first, then blended
    std::vector<engine::Primitive> casters; // what casts a shadow
    std::unique_ptr<engine::MeshBuffer> mesh;
    std::vector<std::unique_ptr<engine::Texture>> textures;
    const engine::Texture* white = nullptr; // one texel
    glm::vec3 min{0.0f}, max{0.0f};         // metres
};

/// The material that covers the largest area: the skin.
std::uint32_t skin_material(const engine::Model& model);

/// Uploads the model. Skin triangles that an anchor's patch reaches become parts of their own.
Head upload_head(const engine::Device& device, const engine::Model& model, std::span<const Anchor> anchors);

} // namespace passes
