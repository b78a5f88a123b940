#include "tools/head/quad_mesh.hpp"

#include <numeric>
#include <unordered_map>

namespace head_tool {
namespace {

struct Edge
{
    std::uint32_t point; // index of its new vertex or texture coordinate
    glm::dvec3 face_points{0.0};
    int faces = 0;
    std::uint32_t a, b; // ends
};

/// Numbers undirected edges from `first` on.
class Edges
{
  public:
    explicit Edges(std::size_t first) : next_(static_cast<std::uint32_t>(first)) {}

    Edge& between(std::uint32_t a, std::uint32_t b)
    {
        const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        const auto [found, is_new] = edges_.try_emplace(key);
        if (is_new) {
            found->second.point = next_++;
            found->second.a = a;
            found->second.b = b;
        }
        return found->second;
    }
    std::size_t end() const { return next_; }
    const auto& all() const { return edges_; }

  private:
    std::unordered_map<std::uint64_t, Edge> edges_;
    std::uint32_t next_;
};

/// Sums over the neighbourhood of an old vertex.
struct Ring
{
    glm::dvec3 face_points{0.0}, edge_middles{0.0}, open_middles{0.0};
    int faces = 0, edges = 0, open_edges = 0;
};

glm::dvec3 moved(glm::dvec3 old, const Ring& ring)
{
    if (ring.open_edges == 2) // on an open edge: cubic B-spline along the edge
        return 0.5 * old + 0.25 * ring.open_middles;
    if (ring.open_edges > 0 || ring.faces != ring.edges || ring.faces == 0)
        return old; // several borders meet, or the vertex is unused
    const double n = ring.faces;
    return (ring.face_points / n + 2.0 * ring.edge_middles / n + (n - 3.0) * old) / n;
}

} // namespace

QuadMesh subdivide(const QuadMesh& mesh)
{
    const std::size_t vertices = mesh.positions.size(), faces = mesh.faces.size();
    QuadMesh fine;
    // New vertices: the old ones, then one per edge, then one per face. Texture coordinates likewise.
    Edges edges(vertices), uv_edges(mesh.uvs.size());
    std::vector<glm::dvec3> face_points(faces);
    std::vector<glm::dvec2> face_uvs(faces);
    std::vector<Ring> rings(vertices);
    for (std::size_t f = 0; f < faces; ++f) {
        const QuadMesh::Face& face = mesh.faces[f];
        for (int c = 0; c < 4; ++c) {
            face_points[f] += 0.25 * mesh.positions[face.vertex[c]];
            face_uvs[f] += 0.25 * mesh.uvs[face.uv[c]];
        }
        for (int c = 0; c < 4; ++c) {
            Edge& edge = edges.between(face.vertex[c], face.vertex[(c + 1) % 4]);
            edge.face_points += face_points[f];
            ++edge.faces;
            uv_edges.between(face.uv[c], face.uv[(c + 1) % 4]);
            rings[face.vertex[c]].face_points += face_points[f];
            ++rings[face.vertex[c]].faces;
        }
    }

    fine.positions.resize(edges.end() + faces);
    for (const auto& [key, edge] : edges.all()) {
        const glm::dvec3 middle = 0.5 * (mesh.positions[edge.a] + mesh.positions[edge.b]);
        fine.positions[edge.point] = edge.faces == 2 ? 0.5 * middle + 0.25 * edge.face_points : middle;
        for (std::uint32_t end : {edge.a, edge.b}) {
            rings[end].edge_middles += middle;
            ++rings[end].edges;
            if (edge.faces != 2) {
                rings[end].open_middles += middle;
                ++rings[end].open_edges;
            }
        }
    }
    for (std::size_t v = 0; v < vertices; ++v)
        fine.positions[v] = moved(mesh.positions[v], rings[v]);
    std::copy(face_points.begin(), face_points.end(),
              fine.positions.begin() + static_cast<std::ptrdiff_t>(edges.end()));

    fine.uvs = mesh.uvs;
    fine.uvs.resize(uv_edges.end() + faces);
    for (const auto& [key, edge] : uv_edges.all())
        fine.uvs[edge.point] = 0.5 * (mesh.uvs[edge.a] + mesh.uvs[edge.b]);
    std::copy(face_uvs.begin(), face_uvs.end(),
              fine.uvs.begin() + static_cast<std::ptrdiff_t>(uv_edges.end()));

    fine.faces.reserve(4 * faces);
    for (std::size_t f = 0; f < faces; ++f) {
        const auto& [vertex, uv] = mesh.faces[f];
        const auto face_vertex = static_cast<std::uint32_t>(edges.end() + f);
        const auto face_uv = static_cast<std::uint32_t>(uv_edges.end() + f);
        for (int c = 0; c < 4; ++c) {
            const int next = (c + 1) % 4, before = (c + 3) % 4;
            fine.faces.push_back({{vertex[c], edges.between(vertex[c], vertex[next]).point, face_vertex,
                                   edges.between(vertex[before], vertex[c]).point},
                                  {uv[c], uv_edges.between(uv[c], uv[next]).point, face_uv,
                                   uv_edges.between(uv[before], uv[c]).point}});
        }
    }
    return fine;
}

std::vector<std::uint32_t> texture_charts(const QuadMesh& mesh)
{
    std::vector<std::uint32_t> parent(mesh.uvs.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i)
            i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const QuadMesh::Face& face : mesh.faces)
        for (int c = 1; c < 4; ++c)
            parent[root(face.uv[c])] = root(face.uv[0]);
    std::unordered_map<std::uint32_t, std::uint32_t> number;
    std::vector<std::uint32_t> charts;
    for (const QuadMesh::Face& face : mesh.faces)
        charts.push_back(
            number.try_emplace(root(face.uv[0]), static_cast<std::uint32_t>(number.size())).first->second);
    return charts;
}

} // namespace head_tool
