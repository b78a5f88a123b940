#include "head/model.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include "base/input_error.hpp"
#include "head/gltf_load.hpp"
#include "head/gltf_parse.hpp"

namespace head {
namespace {

void complete(RawMesh& mesh, std::vector<std::string>& notes)
{
    if (complete_uvs(mesh))
        notes.push_back("no texture coordinates: projected from a cylinder");
    if (complete_normals(mesh))
        notes.push_back("no normals, or unusable ones: computed");
    if (complete_tangents(mesh))
        notes.push_back("no tangents, or unusable ones: computed");
}

/// Reorders the triangles into one primitive per material, in the order of `materials`.
void group_by_material(RawMesh& mesh, const std::vector<std::uint32_t>& materials)
{
    std::vector<std::uint32_t> indices;
    indices.reserve(mesh.indices.size());
    std::vector<Primitive> grouped;
    for (std::uint32_t m = 0; m < materials.size(); ++m) {
        const auto first = static_cast<std::uint32_t>(indices.size());
        for (const Primitive& primitive : mesh.primitives)
            if (primitive.material == materials[m])
                indices.insert(indices.end(), mesh.indices.begin() + primitive.first_index,
                               mesh.indices.begin() + primitive.first_index + primitive.index_count);
        grouped.push_back({first, static_cast<std::uint32_t>(indices.size()) - first, m});
    }
    mesh.indices = std::move(indices);
    mesh.primitives = std::move(grouped);
}

} // namespace

Model load_model(const std::filesystem::path& path)
{
    const std::string file = path.string();
    const tinygltf::Model gltf = parse_gltf(path);
    const GltfReader reader(gltf, file);
    Model model;
    RawMesh mesh = gather_mesh(gltf, reader, model.notes);
    if (const std::size_t dropped = drop_degenerate(mesh))
        model.notes.push_back(fmt::format("{} triangles without area: left out", dropped));
    if (mesh.indices.empty())
        throw base::InputError(file, "contains no triangles with an area", "export the head's mesh into it");
    complete(mesh, model.notes);

    std::vector<std::uint32_t> used; // materials, in the order of their first use
    for (const Primitive& primitive : mesh.primitives)
        if (std::find(used.begin(), used.end(), primitive.material) == used.end())
            used.push_back(primitive.material);
    group_by_material(mesh, used);
    model.materials = gather_materials(gltf, reader, used, model.notes);
    model.vertices = std::move(mesh.vertices);
    model.indices = std::move(mesh.indices);
    model.primitives = std::move(mesh.primitives);
    update_bounds(model);
    return model;
}

std::array<glm::vec3, 3> corners_of(const Model& model, std::size_t first)
{
    const auto corner = [&](std::size_t k) { return model.vertices[model.indices[first + k]].position; };
    return {corner(0), corner(1), corner(2)};
}

void update_bounds(Model& model)
{
    model.min = model.max = model.vertices[0].position;
    for (const Vertex& vertex : model.vertices) {
        model.min = glm::min(model.min, vertex.position);
        model.max = glm::max(model.max, vertex.position);
    }
}

void normalise_size(Model& model)
{
    constexpr float smallest = 0.1f, greatest = 1.0f, wanted = 0.25f; // metres
    const glm::vec3 extent = model.max - model.min;
    // For a horizontal flat model, which has no height, use its longest side.
    const float height = extent.y > 0 ? extent.y : std::max(extent.x, extent.z);
    if (height >= smallest && height <= greatest)
        return;
    const float factor = wanted / height;
    for (Vertex& vertex : model.vertices)
        vertex.position *= factor;
    model.min *= factor;
    model.max *= factor;
    model.notes.push_back(fmt::format("{:.4g} m high: scaled to {} m", height, wanted));
}

void order_for_drawing(Model& model)
{
    for (const Primitive& primitive : model.primitives) {
        if (model.materials[primitive.material].alpha != AlphaMode::Opaque)
            continue;
        std::uint32_t* const first = model.indices.data() + primitive.first_index;
        meshopt_optimizeVertexCache(first, first, primitive.index_count, model.vertices.size());
    }
    model.vertices.resize(meshopt_optimizeVertexFetch(model.vertices.data(), model.indices.data(),
                                                      model.indices.size(), model.vertices.data(),
                                                      model.vertices.size(), sizeof(Vertex)));
}

} // namespace head
