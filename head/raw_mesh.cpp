#include "head/raw_mesh.hpp"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "head/weld.hpp"

namespace head {
namespace {

bool any_unknown(const RawMesh& mesh, RawMesh::Known what)
{
    for (std::uint8_t known : mesh.known)
        if (!(known & what))
            return true;
    return false;
}

std::uint32_t duplicate(RawMesh& mesh, std::uint32_t vertex)
{
    mesh.vertices.push_back(Vertex(mesh.vertices[vertex]));
    mesh.known.push_back(std::uint8_t(mesh.known[vertex]));
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

double corner_angle(glm::dvec3 corner, glm::dvec3 a, glm::dvec3 b)
{
    const glm::dvec3 u = a - corner, v = b - corner;
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

glm::dvec3 any_perpendicular(glm::dvec3 normal)
{
    const glm::dvec3 across =
        glm::cross(glm::dvec3(0, 1, 0), normal); // horizontal: +x on a face that looks along +z
    if (glm::length(across) > 1e-3)
        return glm::normalize(across);
    return glm::normalize(glm::cross(normal, glm::dvec3(0, 0, 1)));
}

struct Triangle
{
    std::array<std::uint32_t, 3> v;
    std::array<glm::dvec3, 3> p;
};

Triangle triangle_at(const RawMesh& mesh, std::size_t first)
{
    Triangle triangle;
    for (int c = 0; c < 3; ++c) {
        triangle.v[c] = mesh.indices[first + c];
        triangle.p[c] = mesh.vertices[triangle.v[c]].position;
    }
    return triangle;
}

/// The direction of increasing u, and whether the texture chart is mirrored.
struct ChartFrame
{
    glm::dvec3 along_u{0.0};
    bool mirrored = false;
};

ChartFrame chart_frame(const RawMesh& mesh, const Triangle& t)
{
    const glm::dvec2 uv0 = mesh.vertices[t.v[0]].uv;
    const glm::dvec2 d1 = glm::dvec2(mesh.vertices[t.v[1]].uv) - uv0,
                     d2 = glm::dvec2(mesh.vertices[t.v[2]].uv) - uv0;
    // The minus: v points down in glTF, but the bitangent points up, as in a right-handed frame.
    const double area = -(d1.x * d2.y - d1.y * d2.x);
    const glm::dvec3 along = ((t.p[1] - t.p[0]) * -d2.y + (t.p[2] - t.p[0]) * d1.y) * (area < 0 ? -1.0 : 1.0);
    const double length = glm::length(along);
    if (area == 0 || !(length > 0))
        return {};
    return {along / length, area < 0};
}

} // namespace

std::size_t drop_degenerate(RawMesh& mesh)
{
    std::size_t kept = 0, dropped = 0;
    for (Primitive& primitive : mesh.primitives) {
        const std::size_t begin = primitive.first_index, end = begin + primitive.index_count;
        primitive.first_index = static_cast<std::uint32_t>(kept);
        for (std::size_t i = begin; i < end; i += 3) {
            const Triangle t = triangle_at(mesh, i);
            const glm::dvec3 a = t.p[1] - t.p[0], b = t.p[2] - t.p[0];
            const double longest = std::max(glm::dot(a, a), glm::dot(b, b));
            if (!(glm::length(glm::cross(a, b)) > 1e-9 * longest))
            { // relative, so that the size of the model does not matter
                ++dropped;
                continue;
            }
            for (int c = 0; c < 3; ++c)
                mesh.indices[kept++] = t.v[c];
        }
        primitive.index_count = static_cast<std::uint32_t>(kept - primitive.first_index);
    }
    mesh.indices.resize(kept);
    std::erase_if(mesh.primitives, [](const Primitive& primitive) { return primitive.index_count == 0; });

    RawMesh used;
    std::vector<std::uint32_t> renumbered(mesh.vertices.size(), ~0u);
    for (std::uint32_t& index : mesh.indices) {
        if (renumbered[index] == ~0u) {
            renumbered[index] = static_cast<std::uint32_t>(used.vertices.size());
            used.vertices.push_back(mesh.vertices[index]);
            used.known.push_back(mesh.known[index]);
        }
        index = renumbered[index];
    }
    mesh.vertices = std::move(used.vertices);
    mesh.known = std::move(used.known);
    return dropped;
}

bool complete_uvs(RawMesh& mesh)
{
    if (!any_unknown(mesh, RawMesh::Uv))
        return false;
    glm::vec3 low(mesh.vertices[0].position), high = low;
    for (const Vertex& vertex : mesh.vertices) {
        low = glm::min(low, vertex.position);
        high = glm::max(high, vertex.position);
    }
    const glm::vec3 middle = 0.5f * (low + high);
    const float height = high.y > low.y ? high.y - low.y : 1.0f;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (mesh.known[v] & RawMesh::Uv)
            continue;
        const glm::vec3 p = mesh.vertices[v].position - middle;
        const float angle = p.x == 0 && p.z == 0 ? 0.0f : std::atan2(p.x, p.z);
        mesh.vertices[v].uv = {0.5f + angle / glm::two_pi<float>(),
                               (high.y - mesh.vertices[v].position.y) / height};
    }
    std::unordered_map<std::uint32_t, std::uint32_t> past_seam; // vertex -> its copy with u + 1
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        float greatest = 0;
        for (int c = 0; c < 3; ++c)
            greatest = std::max(greatest, mesh.vertices[mesh.indices[i + c]].uv.x);
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t index = mesh.indices[i + c];
            if ((mesh.known[index] & RawMesh::Uv) || greatest - mesh.vertices[index].uv.x <= 0.5f)
                continue;
            const auto [found, is_new] = past_seam.try_emplace(index, 0);
            if (is_new) {
                found->second = duplicate(mesh, index);
                mesh.vertices.back().uv.x += 1.0f;
            }
            mesh.indices[i + c] = found->second;
        }
    }
    for (std::uint8_t& known : mesh.known)
        known |= RawMesh::Uv;
    return true;
}

bool complete_normals(RawMesh& mesh)
{
    if (!any_unknown(mesh, RawMesh::Normal))
        return false;
    const auto place = weld<3>(mesh.vertices.size(), [&](std::size_t v) {
        const glm::vec3 p = mesh.vertices[v].position;
        return Key<3>{{bits_of(p.x), bits_of(p.y), bits_of(p.z)}};
    });
    std::vector<glm::dvec3> sum(mesh.vertices.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Triangle t = triangle_at(mesh, i);
        const glm::dvec3 face = glm::normalize(glm::cross(t.p[1] - t.p[0], t.p[2] - t.p[0]));
        for (int c = 0; c < 3; ++c)
            sum[place[t.v[c]]] += face * corner_angle(t.p[c], t.p[(c + 1) % 3], t.p[(c + 2) % 3]);
    }
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (mesh.known[v] & RawMesh::Normal)
            continue;
        const glm::dvec3 normal = sum[place[v]];
        const double length = glm::length(normal);
        // Normals of two sheets back to back cancel; any direction is acceptable there.
        mesh.vertices[v].normal = length > 1e-12 ? glm::vec3(normal / length) : glm::vec3(0, 0, 1);
        mesh.known[v] |= RawMesh::Normal;
    }
    return true;
}

bool complete_tangents(RawMesh& mesh)
{
    if (!any_unknown(mesh, RawMesh::Tangent))
        return false;
    // Duplicate vertices shared by mirrored and unmirrored charts, because a vertex has one handedness.
    std::vector<ChartFrame> frames(mesh.indices.size() / 3);
    std::vector<std::uint8_t> handed(mesh.vertices.size(), 0); // 0 unknown, 1 unmirrored, 2 mirrored
    std::unordered_map<std::uint32_t, std::uint32_t> mirror_copy;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        frames[i / 3] = chart_frame(mesh, triangle_at(mesh, i));
        if (frames[i / 3].along_u == glm::dvec3(0.0))
            continue;
        const std::uint8_t hand = frames[i / 3].mirrored ? 2 : 1;
        for (int c = 0; c < 3; ++c) {
            std::uint32_t& index = mesh.indices[i + c];
            if (mesh.known[index] & RawMesh::Tangent)
                continue;
            if (handed[index] == 0)
                handed[index] = hand;
            if (handed[index] == hand)
                continue;
            const auto [found, is_new] = mirror_copy.try_emplace(index, 0);
            if (is_new) {
                found->second = duplicate(mesh, index);
                handed.push_back(hand);
            }
            index = found->second;
        }
    }

    const auto corner = weld<9>(mesh.vertices.size(), [&](std::size_t v) {
        const Vertex& x = mesh.vertices[v];
        return Key<9>{{bits_of(x.position.x), bits_of(x.position.y), bits_of(x.position.z),
                       bits_of(x.normal.x), bits_of(x.normal.y), bits_of(x.normal.z), bits_of(x.uv.x),
                       bits_of(x.uv.y), handed[v]}};
    });
    std::vector<glm::dvec3> sum(mesh.vertices.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Triangle t = triangle_at(mesh, i);
        for (int c = 0; c < 3; ++c) {
            const glm::dvec3 normal = mesh.vertices[t.v[c]].normal;
            const glm::dvec3 in_plane =
                frames[i / 3].along_u - normal * glm::dot(normal, frames[i / 3].along_u);
            const double length = glm::length(in_plane);
            if (length > 1e-9)
                sum[corner[t.v[c]]] +=
                    in_plane / length * corner_angle(t.p[c], t.p[(c + 1) % 3], t.p[(c + 2) % 3]);
        }
    }
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (mesh.known[v] & RawMesh::Tangent)
            continue;
        const glm::dvec3 normal = mesh.vertices[v].normal;
        glm::dvec3 tangent = sum[corner[v]] - normal * glm::dot(normal, sum[corner[v]]);
        const double length = glm::length(tangent);
        tangent = length > 1e-9 ? tangent / length : any_perpendicular(normal);
        mesh.vertices[v].tangent = glm::vec4(glm::vec3(tangent), handed[v] == 2 ? -1.0f : 1.0f);
        mesh.known[v] |= RawMesh::Tangent;
    }
    return true;
}

} // namespace head
