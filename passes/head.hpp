// A head on the device: its mesh, its materials' textures, and what kind of surface each of its parts is.
#pragma once
#include <memory>
#include <vector>

#include "engine/model.hpp"
#include "engine/texture.hpp"

namespace passes {

enum class Surface : std::uint8_t
{
    Skin, // the material that covers most of the head; takes wounds and translucency
    Eye,  // smooth and wet: a narrow highlight, no translucency
    Hair, // brows and lashes: blended, no highlight
    Other // teeth, mouth, clothes: Lambert only
};

struct HeadPart
{
    Surface surface = Surface::Skin;
    std::uint32_t first_index = 0, index_count = 0;
    bool blend = false, double_sided = false;
    const engine::Texture *albedo = nullptr, *normal = nullptr, *occlusion = nullptr; // never null after upload
    glm::vec4 albedo_factor{1.0f};
    float normal_scale = 1.0f;
    bool wounded = false; // receives at least one wound
};

/// Owns the textures; parts are sorted opaque first, then blended.
struct Head
{
    std::vector<HeadPart> parts;
    std::unique_ptr<engine::MeshBuffer> mesh;
    std::vector<std::unique_ptr<engine::Texture>> textures;
    std::uint32_t skin_material = 0; // index into the model's materials
    glm::vec3 min{0.0f}, max{0.0f};  // metres
};

/// The material that covers the largest area: the skin.
std::uint32_t skin_material(const engine::Model& model);

/// Uploads the model. Skin triangles that an anchor's patch reaches become parts of their own, marked `wounded`.
Head upload_head(engine::Device& device, const engine::Model& model, std::span<const struct Anchor> anchors);

} // namespace passes
