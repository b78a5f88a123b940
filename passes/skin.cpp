#include "passes/skin.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>
#include <unordered_map>

namespace passes {
namespace {

constexpr double most_texels = 8e6; // of each map: 28 bytes all together
constexpr double longest_side = 8192;
// Pixels of a texel's width where the camera is nearest; a wound's texels are half as wide. Wider ones than
// wanted are taken when the wanted ones would be too many.
constexpr double wanted_pixels = 2, most_pixels = 4;
constexpr double usual_albedo = .5, most_diffused_texels = 1e6;

struct SkinVertex
{
    head::Vertex vertex;
    glm::vec2 place;         // share of the atlas' size
    glm::vec2 outward{0.0f}; // of a skirt
};

constexpr std::array<graph::VertexAttribute, 9> attributes{{
    {"position", 3, offsetof(SkinVertex, vertex.position)},
    {"normal", 3, offsetof(SkinVertex, vertex.normal)},
    {"tangent", 4, offsetof(SkinVertex, vertex.tangent)},
    {"uv", 2, offsetof(SkinVertex, vertex.uv)},
    {"occlusion", 1, offsetof(SkinVertex, vertex.occlusion)},
    {"curvature", 2, offsetof(SkinVertex, vertex.curvature)},
    {"thinness", 1, offsetof(SkinVertex, vertex.thinness)},
    {"place", 2, offsetof(SkinVertex, place)},
    {"outward", 2, offsetof(SkinVertex, outward)},
}};
constexpr graph::VertexLayout layout{sizeof(SkinVertex), attributes};

constexpr std::array<graph::VertexAttribute, 6> surface_attributes{{
    {"place", 2, offsetof(head::SurfaceVertex, at)},
    {"outward", 2, offsetof(head::SurfaceVertex, at_outward)},
    {"from", 2, offsetof(head::SurfaceVertex, from)},
    {"from_outward", 2, offsetof(head::SurfaceVertex, from_outward)},
    {"position", 3, offsetof(head::SurfaceVertex, position)},
    {"position_outward", 3, offsetof(head::SurfaceVertex, position_outward)},
}};
constexpr graph::VertexLayout surface_layout{sizeof(head::SurfaceVertex), surface_attributes};

void append(head::AtlasSurface& whole, const head::AtlasSurface& more)
{
    const auto vertices = std::uint32_t(whole.vertices.size()), indices = std::uint32_t(whole.indices.size());
    whole.vertices.insert(whole.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const std::uint32_t index : more.indices)
        whole.indices.push_back(vertices + index);
    for (head::SurfacePiece piece : more.pieces) {
        piece.first_index += indices;
        whole.pieces.push_back(piece);
    }
}

/// A material's occlusion map, small enough that a vertex can take what a texel says.
cv::Mat1b small_occlusion(const head::Material& material)
{
    cv::Mat1b small;
    if (!material.occlusion.empty())
        cv::resize(material.occlusion, small,
                   {std::min(material.occlusion.cols, 256), std::min(material.occlusion.rows, 256)}, 0, 0,
                   cv::INTER_AREA);
    return small;
}

class Spreading
{
  public:
    Spreading(const head::Model& model, const head::Atlas& atlas, std::span<const WoundReach> wounds)
        : model_(model), size_(atlas.size), wounds_(wounds)
    {
        for (const head::Material& material : model.materials)
            occlusion_.push_back(small_occlusion(material));
        material_.resize(model.indices.size() / 3);
        for (const head::Primitive& primitive : model.primitives)
            std::fill_n(material_.begin() + primitive.first_index / 3, primitive.index_count / 3,
                        primitive.material);
    }

    /// A tile of a material: without wounds.
    void add_base(const head::AtlasTile& tile)
    {
        std::vector<head::AtlasTriangle> whole, rest;
        for (const head::AtlasTriangle& triangle : tile.home)
            (wounds_on(model_, triangle.first, wounds_).empty() ? whole : rest).push_back(triangle);
        const std::vector<Group> home = groups(tile.home, false);
        append(groups(tile.margin, false), tile, skin.spread);
        append(skirts(home), tile, skin.spread);
        append(home, tile, skin.spread);
        show(groups(whole, false), tile);
        append(groups(rest, true), tile, skin.rest);
    }

    /// A tile around a wound.
    void add_wound(const head::AtlasTile& tile, const head::Anchor& anchor)
    {
        if (tile.home.empty())
            return;
        const std::vector<Group> home = groups(tile.home, true);
        std::vector<Group> margin = groups(tile.margin, false); // one for each material: their order matters
        std::set<std::uint32_t> all;
        for (const Group& group : home)
            all.insert(group.wounds.begin(), group.wounds.end());
        const WoundSet wounds = drawn_near({all.begin(), all.end()}, anchor.centre, wounds_);
        for (Group& group : margin)
            group.wounds = wounds;
        append(margin, tile, skin.spread);
        append(skirts(home), tile,
               skin.spread); // over the margin, which beyond an outline is skin far behind
        append(home, tile, skin.spread);
        show(home, tile);
    }

    /// After all tiles: the camera's draws, few however many wounds there are.
    void finish()
    {
        for (const auto& [key, drawn] : shown_) {
            skin.shown.push_back(
                {std::uint32_t(indices.size()), std::uint32_t(drawn.size()), key.second, key.first});
            indices.insert(indices.end(), drawn.begin(), drawn.end());
        }
        skin.lit.insert(skin.lit.end(), skin.rest.begin(), skin.rest.end());
    }

    struct Group
    {
        std::uint32_t material = 0;
        WoundSet wounds; // HeadPart::wounds
        std::vector<std::uint32_t> indices;
    };

    Skin skin;
    std::vector<SkinVertex> vertices;
    std::vector<std::uint32_t> indices;

  private:
    static Group& group_of(std::vector<Group>& groups, std::uint32_t material, const WoundSet& wounds)
    {
        const auto known = std::ranges::find_if(
            groups, [&](const Group& group) { return group.material == material && group.wounds == wounds; });
        return known != groups.end() ? *known : groups.emplace_back(Group{material, wounds, {}});
    }

    std::vector<Group> groups(std::span<const head::AtlasTriangle> triangles, bool with_wounds)
    {
        std::vector<Group> result;
        for (const head::AtlasTriangle& triangle : triangles) {
            Group& group = group_of(result, material_[triangle.first / 3],
                                    with_wounds ? wounds_on(model_, triangle.first, wounds_) : WoundSet());
            for (std::uint32_t k = 0; k < 3; ++k)
                group.indices.push_back(
                    vertex(model_.indices[triangle.first + k], triangle.at[k], group.material));
        }
        return result;
    }

    std::vector<Group> skirts(std::span<const Group> groups)
    {
        std::vector<Group> result(groups.begin(), groups.end());
        for (Group& group : result)
            group.indices = skirt(group.indices);
        return result;
    }

    std::uint32_t vertex(std::uint32_t index, const glm::vec2& at, std::uint32_t material)
    {
        const std::uint64_t place =
            std::uint64_t{std::bit_cast<std::uint32_t>(at.x)} << 32 | std::bit_cast<std::uint32_t>(at.y);
        auto& known = known_[index];
        for (const auto& [where, vertex] : known)
            if (where == place)
                return vertex;
        SkinVertex made{model_.vertices[index], at / glm::vec2(size_)};
        if (const cv::Mat1b& map = occlusion_[material]; !map.empty()) {
            const glm::vec2 uv = made.vertex.uv - glm::floor(made.vertex.uv);
            made.vertex.occlusion = float(map(std::min(int(uv.y * float(map.rows)), map.rows - 1),
                                              std::min(int(uv.x * float(map.cols)), map.cols - 1))) /
                                    255;
        }
        vertices.push_back(made);
        known.emplace_back(place, std::uint32_t(vertices.size() - 1));
        return known.back().second;
    }

    /// A strip along the border of charts, with the attributes of the border: filters that reach beyond it
    /// find the same skin there. Returns its indices.
    std::vector<std::uint32_t> skirt(std::span<const std::uint32_t> triangles)
    {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<std::uint32_t, 4>>
            edges; // a, b, opposite, count
        for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = triangles[i + k], b = triangles[i + (k + 1) % 3];
                auto& edge = edges[{std::min(a, b), std::max(a, b)}];
                edge = {a, b, triangles[i + (k + 2) % 3], edge[3] + 1};
            }
        const auto place = [&](std::uint32_t vertex) { return vertices[vertex].place * glm::vec2(size_); };
        std::map<std::uint32_t, glm::vec2> outward;
        std::vector<std::array<std::uint32_t, 2>> border;
        for (const auto& [ends, edge] : edges) {
            const glm::vec2 along = place(edge[1]) - place(edge[0]), inward = place(edge[2]) - place(edge[0]);
            glm::vec2 across(-along.y, along.x);
            const float length = glm::length(across);
            if (edge[3] != 1 || !(length > 1e-6f))
                continue;
            across /= glm::dot(across, inward) > 0 ? -length : length;
            outward[edge[0]] += across;
            outward[edge[1]] += across;
            border.push_back({edge[0], edge[1]});
        }
        std::map<std::uint32_t, std::uint32_t> outer;
        for (const auto& [vertex, sum] : outward) {
            SkinVertex made = vertices[vertex];
            made.outward = head::mitred(sum);
            outer[vertex] = std::uint32_t(vertices.size());
            vertices.push_back(made);
        }
        std::vector<std::uint32_t> result;
        for (const auto [a, b] : border)
            result.insert(result.end(), {a, b, outer[b], a, outer[b], outer[a]});
        return result;
    }

    void show(std::span<const Group> groups, const head::AtlasTile& tile)
    {
        append(groups, tile, skin.lit);
        for (const Group& group : groups) {
            std::vector<std::uint32_t>& all = shown_[{!group.wounds.empty(), group.material}];
            all.insert(all.end(), group.indices.begin(), group.indices.end());
        }
    }

    void append(std::span<const Group> groups, const head::AtlasTile& tile, std::vector<SkinDraw>& draws)
    {
        for (const Group& group : groups) {
            if (group.indices.empty())
                continue;
            draws.push_back({std::uint32_t(indices.size()), std::uint32_t(group.indices.size()),
                             group.material, group.wounds, tile.corner, tile.size});
            indices.insert(indices.end(), group.indices.begin(), group.indices.end());
        }
    }

    const head::Model& model_;
    glm::uvec2 size_;
    std::span<const WoundReach> wounds_;
    std::vector<cv::Mat1b> occlusion_;    // by material
    std::vector<std::uint32_t> material_; // by triangle of the model
    std::unordered_map<std::uint32_t, std::vector<std::pair<std::uint64_t, std::uint32_t>>>
        known_;                                                                  // by vertex of the model
    std::map<std::pair<bool, std::uint32_t>, std::vector<std::uint32_t>> shown_; // by wounded and material
};

} // namespace

std::vector<std::uint32_t> kept_materials(const head::Model& model)
{
    std::vector<std::uint32_t> materials = head::atlas_materials(model);
    std::erase_if(materials, [&](std::uint32_t material) { return model.materials[material].double_sided; });
    return materials;
}

std::shared_ptr<const Skin> upload_skin(const gpu::Device& device, const head::Model& model,
                                        const head::Atlas& atlas, const head::AtlasSurface& surface,
                                        std::span<const WoundReach> wounds)
{
    Spreading spreading(model, atlas, wounds);
    for (const head::AtlasTile& tile : atlas.materials)
        spreading.add_base(tile);
    for (std::size_t i = 0; i < atlas.wounds.size(); ++i)
        spreading.add_wound(atlas.wounds[i], wounds[i].anchor);
    spreading.finish();
    if (spreading.indices.empty())
        return nullptr;
    Skin& skin = spreading.skin;
    skin.mesh = std::make_shared<const gpu::MeshBuffer>(
        device, layout, std::as_bytes(std::span(spreading.vertices)), spreading.indices, "skin");
    skin.materials = kept_materials(model);
    skin.size = atlas.size;
    skin.texel_m = head::texel_m(atlas, 1);
    glm::uvec2 low = atlas.size, high(0);
    for (const head::AtlasTile& tile : atlas.wounds)
        if (tile.size.x > 0) {
            low = glm::min(low, tile.corner);
            high = glm::max(high, tile.corner + tile.size);
        }
    skin.wounded_corner = glm::min(low, high);
    skin.wounded_size = high - skin.wounded_corner;
    head::AtlasSurface whole = surface;
    append(whole, head::surface_of(model, atlas.wounds, false));
    skin.surface = whole.pieces;
    skin.surface_mesh = std::make_shared<const gpu::MeshBuffer>(
        device, surface_layout, std::as_bytes(std::span(whole.vertices)), whole.indices, "skin surface");
    return std::make_shared<const Skin>(std::move(skin));
}

double pixel_m(std::span<const Bounds> head, const head::Camera& camera, std::uint32_t height)
{
    double nearest = 1e9; // m
    for (const Bounds& box : head) {
        const glm::dvec3 inside = glm::clamp(camera.eye, glm::dvec3(box.min), glm::dvec3(box.max));
        nearest = std::min(nearest, glm::distance(camera.eye, inside));
    }
    return 2 * std::tan(glm::radians(camera.fov_deg) / 2) * nearest / height;
}

std::optional<double> atlas_scale(const Skin& skin, double pixel_m)
{
    std::optional<double> finest;
    for (double scale = head::smallest_atlas_scale; scale <= head::largest_atlas_scale; scale *= 2) {
        const glm::dvec2 size = scale * glm::dvec2(skin.size);
        if (size.x * size.y > most_texels || std::max(size.x, size.y) > longest_side)
            break;
        finest = scale;
        if (skin.texel_m / scale <= wanted_pixels * pixel_m)
            return scale;
    }
    return finest && skin.texel_m / *finest <= most_pixels * pixel_m ? finest : std::nullopt;
}

graph::Region scaled(const graph::Region& region, double ratio, double margin, const glm::uvec2& size)
{
    if (region.empty())
        return {};
    const glm::dvec2 low = ratio * glm::dvec2(region.x, region.y) - margin,
                     high = ratio * glm::dvec2(region.x + region.width, region.y + region.height) + margin;
    const glm::uvec2 first(glm::floor(glm::clamp(low, glm::dvec2(0), glm::dvec2(size)))),
        last(glm::ceil(glm::clamp(high, glm::dvec2(0), glm::dvec2(size))));
    return {first.x, first.y, last.x - first.x, last.y - first.y};
}

double diffusion_scale(const Skin& skin, const base::Color& scattering_length_mm, double pixel_m)
{
    const double width_m = std::max(
        pixel_m, 1e-3 * usual_albedo *
                     std::max({scattering_length_mm[0], scattering_length_mm[1], scattering_length_mm[2]}));
    double found = head::smallest_atlas_scale;
    for (double scale = found; scale <= head::largest_atlas_scale; scale *= 2) {
        const glm::dvec2 size = scale * glm::dvec2(skin.size);
        if (size.x * size.y > most_diffused_texels)
            break;
        found = scale;
        if (skin.texel_m / scale <= width_m)
            break;
    }
    return found;
}

} // namespace passes
