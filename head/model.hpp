// A head as the renderer needs it: one vertex and index list, primitives by material, pictures on the CPU.
// Loaded from glTF 2.0 (.glb or .gltf), checked at the door, trusted after.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace head {

struct Vertex
{
    glm::vec3 position; // metres, y up, the face looks along +z
    glm::vec3 normal;   // unit
    glm::vec4 tangent;  // unit, w = +1 or -1 (glTF convention)
    glm::vec2 uv;       // v down
};

enum class AlphaMode : std::uint8_t
{
    Opaque,
    Mask,
    Blend
};

struct Material
{
    std::string name;
    cv::Mat4b base_color; // RGBA, sRGB; empty: only the factor
    glm::vec4 base_color_factor{1.0f};
    cv::Mat3b normal; // RGB, tangent space; empty: flat
    float normal_scale = 1.0f;
    cv::Mat1b occlusion; // ambient occlusion, linear, 255 = open; empty: open
    float roughness = 1.0f;
    AlphaMode alpha = AlphaMode::Opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
};

struct Primitive
{
    std::uint32_t first_index = 0, index_count = 0;
    std::uint32_t material = 0;
};

struct Model
{
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices; // triangles, counter-clockwise seen from outside
    std::vector<Primitive> primitives;
    std::vector<Material> materials; // at least one
    glm::vec3 min{0.0f}, max{0.0f};  // bounds of the vertices
    std::vector<std::string>
        notes; // what was missing and made up ("no normals: computed"), for the user to read
};

/// Throws base::InputError naming the file, the field and the cure. Node transforms are applied; normals
/// and tangents are computed where missing; zero-area triangles are dropped; NaN, out-of-range indices and
/// absurd sizes are refused.
Model load_model(const std::filesystem::path& path);

/// The three corners of the triangle whose first index is at `first`.
std::array<glm::vec3, 3> corners_of(const Model& model, std::size_t first);

/// Sets min and max from the vertices, of which there must be one.
void update_bounds(Model& model);

/// Makes the model a head in metres: scales one whose height is outside 0.1..1 m to 0.25 m and says so in
/// `notes`.
void normalise_size(Model& model);

/// Writes a binary glTF 2.0 file that load_model reads back; PNG pictures inside, opaque colours of more than
/// a megapixel as JPEG. Atomic (temporary name, then rename).
void save_model(const std::filesystem::path& path, const Model& model);

} // namespace head
