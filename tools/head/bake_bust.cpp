#include "tools/head/bake_bust.hpp"

#include <algorithm>
#include <map>

namespace head_tool {
namespace {

/// Height of a point above the bust's base in dm: a plane through the upper chest that rises to the back
/// and curves up to the shoulders.
double above_base(glm::dvec3 p)
{
    constexpr double height = 5.62, tilt = 0.25, shoulder = 0.16; // dm, slope, dm^-1
    return p.y - height - tilt * (0.3 - p.z) - shoulder * p.x * p.x;
}

/// The faces with all corners satisfying `wanted`; keeps all vertices and texture coordinates.
template <typename Wanted>
QuadMesh part_of(const QuadMesh& mesh, Wanted&& wanted)
{
    QuadMesh part{mesh.positions, mesh.uvs, {}};
    for (const QuadMesh::Face& face : mesh.faces)
        if (std::all_of(face.vertex.begin(), face.vertex.end(),
                        [&](auto v) { return wanted(mesh.positions[v]); }))
            part.faces.push_back(face);
    return part;
}

/// Cuts triangles along the base. Neighbouring triangles share the vertices on the cut.
class Cutter
{
  public:
    explicit Cutter(CutMesh& mesh) : mesh_(mesh) {}

    void add(const CutMesh::Triangle& triangle, std::vector<CutMesh::Triangle>& to)
    {
        CutMesh::Corner kept[4];
        int count = 0;
        for (int c = 0; c < 3; ++c) {
            const CutMesh::Corner a = triangle[c], b = triangle[(c + 1) % 3];
            const bool a_above = above(a) >= 0, b_above = above(b) >= 0;
            if (a_above)
                kept[count++] = a;
            if (a_above != b_above)
                kept[count++] = between(a, b);
        }
        for (int c = 2; c < count; ++c)
            to.push_back({kept[0], kept[c - 1], kept[c]});
    }

  private:
    double above(CutMesh::Corner corner) const { return above_base(mesh_.positions[corner.vertex]); }

    CutMesh::Corner between(CutMesh::Corner a, CutMesh::Corner b)
    {
        if (a.vertex > b.vertex)
            std::swap(a, b); // the same rounding for both neighbours
        const double t = above(a) / (above(a) - above(b));
        const auto [vertex, new_vertex] =
            vertices_.try_emplace({a.vertex, b.vertex}, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (new_vertex)
            mesh_.positions.push_back(glm::mix(mesh_.positions[a.vertex], mesh_.positions[b.vertex], t));
        const auto [uv, new_uv] =
            uvs_.try_emplace({a.uv, b.uv}, static_cast<std::uint32_t>(mesh_.uvs.size()));
        if (new_uv)
            mesh_.uvs.push_back(glm::mix(mesh_.uvs[a.uv], mesh_.uvs[b.uv], t));
        return {vertex->second, uv->second};
    }

    CutMesh& mesh_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> vertices_, uvs_;
};

std::array<CutMesh::Triangle, 2> halves(const QuadMesh::Face& face)
{
    const auto corner = [&](int c) { return CutMesh::Corner{face.vertex[c], face.uv[c]}; };
    return {{{corner(0), corner(1), corner(2)}, {corner(0), corner(2), corner(3)}}};
}

} // namespace

CutMesh cut_bust(const QuadMesh& body)
{
    constexpr double margin = 0.8; // dm kept below the cut, for the refinement at the cut
    const QuadMesh coarse = part_of(body, [](glm::dvec3 p) { return above_base(p) > -margin; });
    const auto charts = texture_charts(coarse);
    // The head's chart contains the top of the skull. The torso's charts reach below the cut. All other
    // charts lie inside the head.
    std::vector<bool> is_torso(coarse.faces.size(), false);
    std::uint32_t head = 0;
    double top = -1e9;
    for (std::size_t f = 0; f < coarse.faces.size(); ++f)
        for (std::uint32_t v : coarse.faces[f].vertex) {
            if (coarse.positions[v].y > top) {
                top = coarse.positions[v].y;
                head = charts[f];
            }
            if (above_base(coarse.positions[v]) < 0)
                is_torso[charts[f]] = true; // indexed by chart: there are no more charts than faces
        }

    const QuadMesh fine = subdivide(coarse);
    CutMesh bust{fine.positions, fine.uvs, {}, {}, {}};
    Cutter cutter(bust);
    for (std::size_t f = 0; f < fine.faces.size(); ++f) {
        const std::uint32_t chart = charts[f / 4];
        for (const CutMesh::Triangle& triangle : halves(fine.faces[f]))
            cutter.add(triangle, chart == head ? bust.head : is_torso[chart] ? bust.torso : bust.inner);
    }
    return bust;
}

CutMesh as_triangles(const QuadMesh& mesh)
{
    CutMesh triangles{mesh.positions, mesh.uvs, {}, {}, {}};
    for (const QuadMesh::Face& face : mesh.faces)
        for (const CutMesh::Triangle& triangle : halves(face))
            triangles.head.push_back(triangle);
    return triangles;
}

} // namespace head_tool
