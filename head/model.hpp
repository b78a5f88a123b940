// A head model: one vertex and index list, one primitive per material, pictures on the CPU. Loaded from glTF
// 2.0 (.glb or .gltf); load_model checks everything, so that later code need not.
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
    float occlusion = 1; // share of surroundings that reach it; of materials without a map (head/occlusion.hpp)
    /// 1/m, of the two principal curvatures: mean (convex: > 0), root mean square; compute_curvature() sets it.
    glm::vec2 curvature{0.0f};
    float thinness = 0; // 1/m, 0 where nothing passes; bake_occlusion() (head/occlusion.hpp) sets it
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
        notes; // for the user: data that was missing and replaced ("no normals: computed")
};

/// Applies node transforms, computes missing normals and tangents and drops zero-area triangles. Throws
/// base::InputError, naming file, field and cure, for NaN, out-of-range indices, excessive sizes and other
/// errors.
Model load_model(const std::filesystem::path& path);

/// The corners of the triangle whose first index is model.indices[first].
std::array<glm::vec3, 3> corners_of(const Model& model, std::size_t first);

/// Sets min and max from the vertices; there must be at least one.
void update_bounds(Model& model);

/// Scales a model whose height is outside 0.1..1 m to a height of 0.25 m and adds this to `notes`.
void normalise_size(Model& model);

/// Puts the triangles of each opaque primitive, and then all vertices, into an order in which neighbours use
/// the same vertices soon after each other: a rasteriser then transforms each vertex about once (Forsyth
/// 2006, "Linear-speed vertex cache optimisation"). Triangles of other primitives keep their order, in which
/// they are blended. Call it before anything numbers triangles or vertices.
void order_for_drawing(Model& model);

/// Writes a binary glTF 2.0 file that load_model can read. Pictures are PNG; opaque base colours of more than
/// a megapixel are JPEG. Atomic (temporary name, then rename).
void save_model(const std::filesystem::path& path, const Model& model);

} // namespace head
