#include "head/gltf_load.hpp"

#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace head {
namespace {

constexpr std::size_t max_vertices = 10'000'000;
constexpr float max_coordinate = 1e7f; // model units; rejects e.g. nanometres before anything overflows

bool finite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Copies `from` to `to` after checking count and finiteness; leaves `to` unchanged when `from` is empty.
void take(const std::vector<double>& from, std::span<double> to, const GltfReader& reader,
          const std::string& field)
{
    if (from.empty())
        return;
    if (from.size() != to.size())
        reader.refuse(field, fmt::format("has {} numbers instead of {}", from.size(), to.size()));
    for (std::size_t i = 0; i < to.size(); ++i) {
        if (!std::isfinite(from[i]))
            reader.refuse(field, "is not finite");
        to[i] = from[i];
    }
}

glm::dmat4 local_transform(const tinygltf::Node& node, const GltfReader& reader, const std::string& field)
{
    glm::dmat4 matrix(1.0);
    if (!node.matrix.empty()) {
        take(node.matrix, std::span(glm::value_ptr(matrix), 16), reader, field + "/matrix");
        return matrix;
    }
    double translation[3] = {0, 0, 0}, rotation[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
    take(node.translation, translation, reader, field + "/translation");
    take(node.rotation, rotation, reader, field + "/rotation");
    take(node.scale, scale, reader, field + "/scale");
    glm::dquat turn(rotation[3], rotation[0], rotation[1], rotation[2]);
    const double length = glm::length(turn);
    turn = length > 1e-12 ? turn / length : glm::dquat(1, 0, 0, 0);
    return glm::translate(glm::dmat4(1.0), glm::make_vec3(translation)) * glm::mat4_cast(turn) *
           glm::scale(glm::dmat4(1.0), glm::make_vec3(scale));
}

/// Collects primitives into one mesh.
class Gatherer
{
  public:
    Gatherer(const tinygltf::Model& gltf, const GltfReader& reader) : gltf_(gltf), reader_(reader) {}

    void add_scene();
    RawMesh take_mesh(std::vector<std::string>& notes);

  private:
    void add_mesh(int mesh, const glm::dmat4& transform);
    void add_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& transform,
                       const std::string& field);
    std::size_t add_vertices(const tinygltf::Primitive& primitive, const glm::dmat4& transform,
                             const std::string& field);
    void add_triangles(const tinygltf::Primitive& primitive, std::uint32_t first, std::size_t count,
                       bool mirrored, const std::string& field);
    std::vector<float> attribute(const tinygltf::Primitive& primitive, const std::string& name,
                                 int components, std::size_t count, const std::string& field) const;
    std::string uv_set(const tinygltf::Primitive& primitive) const;
    glm::dmat3 uv_transform(const tinygltf::Primitive& primitive) const;

    const tinygltf::Model& gltf_;
    const GltfReader& reader_;
    RawMesh mesh_;
    bool skinned_ = false, morphed_ = false, lines_ = false;
};

/// Traverses the node tree without recursion. A node visited twice means a cycle or two parents; the standard
/// forbids both.
void Gatherer::add_scene()
{
    struct Visit
    {
        int node;
        glm::dmat4 parent;
    };
    std::vector<Visit> open;
    if (gltf_.scenes.empty()) { // valid glTF: a library of meshes
        for (std::size_t m = 0; m < gltf_.meshes.size(); ++m)
            add_mesh(static_cast<int>(m), glm::dmat4(1.0));
        return;
    }
    const int scene = std::max(gltf_.defaultScene, 0);
    if (static_cast<std::size_t>(scene) >= gltf_.scenes.size())
        reader_.refuse("/scene", fmt::format("there is no scene {}", scene));
    for (int node : gltf_.scenes[scene].nodes)
        open.push_back({node, glm::dmat4(1.0)});
    std::vector<bool> seen(gltf_.nodes.size(), false);
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        const std::string field = fmt::format("/nodes/{}", visit.node);
        if (visit.node < 0 || static_cast<std::size_t>(visit.node) >= gltf_.nodes.size())
            reader_.refuse(field, "there is no such node");
        if (seen[visit.node])
            reader_.refuse(field, "is in a cycle or has two parents");
        seen[visit.node] = true;
        const tinygltf::Node& node = gltf_.nodes[visit.node];
        const glm::dmat4 transform = visit.parent * local_transform(node, reader_, field);
        if (node.mesh >= 0) {
            // By the standard, a skinned mesh ignores its node; without joints it keeps its bind pose.
            add_mesh(node.mesh, node.skin >= 0 ? glm::dmat4(1.0) : transform);
            skinned_ |= node.skin >= 0;
        }
        for (int child : node.children)
            open.push_back({child, transform});
    }
}

void Gatherer::add_mesh(int mesh, const glm::dmat4& transform)
{
    if (static_cast<std::size_t>(mesh) >= gltf_.meshes.size())
        reader_.refuse(fmt::format("/meshes/{}", mesh), "there is no such mesh");
    const auto& primitives = gltf_.meshes[mesh].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p)
        add_primitive(primitives[p], transform, fmt::format("/meshes/{}/primitives/{}", mesh, p));
}

void Gatherer::add_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& transform,
                             const std::string& field)
{
    if (primitive.extensions.contains("KHR_draco_mesh_compression"))
        reader_.refuse(field, "is compressed (KHR_draco_mesh_compression)",
                       "export the model without compression");
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        lines_ = true;
        return;
    }
    if (primitive.material >= static_cast<int>(gltf_.materials.size()))
        reader_.refuse(field + "/material", fmt::format("there is no material {}", primitive.material));
    morphed_ |= !primitive.targets.empty();
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    const std::size_t count = add_vertices(primitive, transform, field);
    add_triangles(primitive, first, count, glm::determinant(glm::dmat3(transform)) < 0, field);
}

std::vector<float> Gatherer::attribute(const tinygltf::Primitive& primitive, const std::string& name,
                                       int components, std::size_t count, const std::string& field) const
{
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end())
        return {};
    const std::string path = field + "/attributes/" + name;
    if (reader_.count(found->second, path) != count)
        reader_.refuse(
            path, fmt::format("has {} elements for {} vertices", reader_.count(found->second, path), count));
    return reader_.numbers(found->second, components, path);
}

/// The texture coordinate set that the base colour uses; a Vertex stores only one set.
std::string Gatherer::uv_set(const tinygltf::Primitive& primitive) const
{
    const int set = primitive.material < 0
                        ? 0
                        : gltf_.materials[primitive.material].pbrMetallicRoughness.baseColorTexture.texCoord;
    return fmt::format("TEXCOORD_{}", set);
}

/// KHR_texture_transform of the base colour, to be applied to the vertices' texture coordinates.
glm::dmat3 Gatherer::uv_transform(const tinygltf::Primitive& primitive) const
{
    glm::dmat3 matrix(1.0);
    if (primitive.material < 0)
        return matrix;
    const auto& extensions =
        gltf_.materials[primitive.material].pbrMetallicRoughness.baseColorTexture.extensions;
    const auto found = extensions.find("KHR_texture_transform");
    if (found == extensions.end())
        return matrix;
    const auto pair = [&](const char* name, double otherwise) {
        const tinygltf::Value& value = found->second.Get(name);
        const bool sound =
            value.IsArray() && value.ArrayLen() == 2 && value.Get(0).IsNumber() && value.Get(1).IsNumber();
        return sound ? glm::dvec2(value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble())
                     : glm::dvec2(otherwise);
    };
    const tinygltf::Value& rotation = found->second.Get("rotation");
    const double angle = rotation.IsNumber() ? rotation.GetNumberAsDouble() : 0.0;
    const glm::dvec2 offset = pair("offset", 0.0), scale = pair("scale", 1.0);
    const double c = std::cos(angle), s = std::sin(angle);
    return glm::dmat3(c * scale.x, -s * scale.x, 0, s * scale.y, c * scale.y, 0, offset.x, offset.y, 1);
}

std::size_t Gatherer::add_vertices(const tinygltf::Primitive& primitive, const glm::dmat4& transform,
                                   const std::string& field)
{
    const auto position_at = primitive.attributes.find("POSITION");
    if (position_at == primitive.attributes.end())
        reader_.refuse(field + "/attributes/POSITION", "is missing");
    const std::size_t count = reader_.count(position_at->second, field + "/attributes/POSITION");
    if (count > max_vertices - mesh_.vertices.size())
        reader_.refuse(field, fmt::format("raises the model's vertices above the limit of {}", max_vertices),
                       "use a smaller model");
    const auto positions = attribute(primitive, "POSITION", 3, count, field);
    const auto normals = attribute(primitive, "NORMAL", 3, count, field);
    const auto tangents = attribute(primitive, "TANGENT", 4, count, field);
    const std::string set = uv_set(primitive);
    const auto uvs = attribute(primitive, set, 2, count, field);

    const glm::dmat3 linear(transform), uv_matrix = uv_transform(primitive);
    const double sign = glm::determinant(linear) < 0 ? -1.0 : 1.0;
    // The cofactor matrix transforms normals and, unlike the inverse transpose, needs no division.
    const glm::dmat3 cofactor(sign * glm::cross(linear[1], linear[2]),
                              sign * glm::cross(linear[2], linear[0]),
                              sign * glm::cross(linear[0], linear[1]));
    for (std::size_t i = 0; i < count; ++i) {
        Vertex vertex{};
        std::uint8_t known = 0;
        vertex.position = glm::vec3(transform * glm::dvec4(glm::make_vec3(&positions[3 * i]), 1.0));
        if (!finite(vertex.position) ||
            glm::any(glm::greaterThan(glm::abs(vertex.position), glm::vec3(max_coordinate))))
            reader_.refuse(field + "/attributes/POSITION",
                           fmt::format("vertex {} is not finite or too far away", i));
        if (!normals.empty()) {
            const glm::dvec3 normal = cofactor * glm::dvec3(glm::make_vec3(&normals[3 * i]));
            vertex.normal = glm::vec3(glm::normalize(normal));
            known |= finite(vertex.normal) ? RawMesh::Normal : 0; // zero or NaN: treated as missing
        }
        if (!tangents.empty() && known) {
            const glm::dvec3 n = vertex.normal, along = linear * glm::dvec3(glm::make_vec3(&tangents[4 * i]));
            vertex.tangent = glm::vec4(glm::vec3(glm::normalize(along - n * glm::dot(n, along))),
                                       (tangents[4 * i + 3] < 0 ? -1.0 : 1.0) * sign);
            known |= finite(vertex.tangent) ? RawMesh::Tangent : 0;
        }
        if (!uvs.empty()) {
            vertex.uv = glm::vec2(uv_matrix * glm::dvec3(uvs[2 * i], uvs[2 * i + 1], 1.0));
            if (!std::isfinite(vertex.uv.x) || !std::isfinite(vertex.uv.y))
                reader_.refuse(field + "/attributes/" + set, fmt::format("vertex {} is not finite", i));
            known |= RawMesh::Uv;
        }
        mesh_.vertices.push_back(vertex);
        mesh_.known.push_back(known);
    }
    return count;
}

void Gatherer::add_triangles(const tinygltf::Primitive& primitive, std::uint32_t first, std::size_t count,
                             bool mirrored, const std::string& field)
{
    std::vector<std::uint32_t> corners;
    if (primitive.indices >= 0) {
        corners = reader_.indices(primitive.indices, count, field + "/indices");
    } else {
        corners.resize(count);
        for (std::size_t i = 0; i < count; ++i)
            corners[i] = static_cast<std::uint32_t>(i);
    }
    const bool list = primitive.mode == TINYGLTF_MODE_TRIANGLES,
               fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    if (list && corners.size() % 3 != 0)
        reader_.refuse(field + "/indices", fmt::format("{} indices make no whole triangles", corners.size()));
    const std::size_t triangles = list ? corners.size() / 3 : corners.size() < 3 ? 0 : corners.size() - 2;
    if (triangles > max_vertices - mesh_.indices.size() / 3)
        reader_.refuse(field, fmt::format("raises the model's triangles above the limit of {}", max_vertices),
                       "use a smaller model");
    const std::uint32_t material = primitive.material < 0 ? static_cast<std::uint32_t>(gltf_.materials.size())
                                                          : static_cast<std::uint32_t>(primitive.material);
    mesh_.primitives.push_back({static_cast<std::uint32_t>(mesh_.indices.size()),
                                static_cast<std::uint32_t>(3 * triangles), material});
    for (std::size_t t = 0; t < triangles; ++t) {
        std::size_t a = list ? 3 * t : fan ? 0 : t, b = list ? a + 1 : t + 1, c = list ? a + 2 : t + 2;
        if (!list && !fan && t % 2 == 1)
            std::swap(b, c); // every second triangle of a strip has reversed winding
        if (mirrored)
            std::swap(b, c);
        for (std::size_t corner : {a, b, c})
            mesh_.indices.push_back(first + corners[corner]);
    }
}

RawMesh Gatherer::take_mesh(std::vector<std::string>& notes)
{
    if (skinned_)
        notes.push_back("skeleton: not applied, the head is shown in its bind pose");
    if (morphed_)
        notes.push_back("morph targets: not applied");
    if (lines_)
        notes.push_back("points and lines: left out");
    return std::move(mesh_);
}

} // namespace

RawMesh gather_mesh(const tinygltf::Model& gltf, const GltfReader& reader, std::vector<std::string>& notes)
{
    Gatherer gatherer(gltf, reader);
    gatherer.add_scene();
    return gatherer.take_mesh(notes);
}

} // namespace head
