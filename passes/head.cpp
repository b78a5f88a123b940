#include "passes/head.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <opencv2/imgproc.hpp>

#include "shaders/shared/frame.h"

namespace passes {
namespace {

/// Its middle, and a distance from it within which the triangle and its box in any frame lie.
std::pair<glm::dvec3, double> ball_around(const head::Model& model, std::size_t first)
{
    const auto corners = head::corners_of(model, first);
    const glm::dvec3 middle = (glm::dvec3(corners[0]) + glm::dvec3(corners[1]) + glm::dvec3(corners[2])) / 3.;
    double radius = 0;
    for (const glm::vec3& corner : corners)
        radius = std::max(radius, glm::distance(glm::dvec3(corner), middle));
    return {middle, std::sqrt(3.) * radius};
}

/// All wounds that can show on the triangle.
WoundSet wounds_reaching(const head::Model& model, std::size_t first, std::span<const WoundReach> wounds)
{
    const double farthest = std::sqrt(2 + head::Anchor::reach * head::Anchor::reach); // half widths
    const auto [middle, radius] = ball_around(model, first);
    WoundSet set;
    for (std::size_t k = 0; k < wounds.size(); ++k) {
        const head::Anchor& anchor = wounds[k].anchor;
        const double within = farthest * anchor.half_width_m + radius;
        const glm::dvec3 apart = middle - anchor.centre;
        if (!(glm::dot(apart, apart) > within * within) && wounds[k].holds(model, first))
            set.push_back(std::uint32_t(k));
    }
    return set;
}

/// Splits a part by the sets of wounds that can show on a triangle; appends to `indices` and to the parts of
/// `head`, and to its wounded triangles.
void append_split(const head::Model& model, std::span<const WoundReach> wounds, HeadPart part,
                  std::vector<std::uint32_t>& indices, Head& head)
{
    std::map<WoundSet, std::vector<std::uint32_t>> split; // by HeadPart::wounds
    for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3) {
        WoundSet set;
        if (part.surface == head::Surface::Skin)
            set = wounds_reaching(model, i, wounds);
        head.crowded += set.size() > shared::WOUNDS_HERE;
        set = drawn_near(std::move(set), ball_around(model, i).first, wounds);
        for (const std::uint32_t k : set)
            head.wounded[k].push_back({head::corners_of(model, i), part.double_sided});
        split[set].insert(split[set].end(), &model.indices[i], &model.indices[i] + 3);
    }
    for (const auto& [set, triangles] : split) {
        part.first_index = std::uint32_t(indices.size());
        part.index_count = std::uint32_t(triangles.size());
        part.wounds = set;
        indices.insert(indices.end(), triangles.begin(), triangles.end());
        head.parts.push_back(part);
    }
}

} // namespace

bool WoundReach::holds(const head::Model& model, std::size_t first) const
{
    glm::dvec3 least(1e30), most(-1e30);
    double facing = 0; // the projection fades before the surface turns away
    for (std::size_t k = first; k < first + 3; ++k) {
        const head::Vertex& vertex = model.vertices[model.indices[k]];
        const glm::dvec3 place = head::in_frame(anchor, glm::dvec3(vertex.position));
        least = glm::min(least, place);
        most = glm::max(most, place);
        facing = std::max(facing, glm::dot(glm::dvec3(vertex.normal), anchor.normal));
    }
    const glm::dvec2 least_on(least), most_on(most);
    return facing > 0 && glm::all(glm::lessThanEqual(least_on, high)) &&
           glm::all(glm::greaterThanEqual(most_on, low)) && least.z <= head::Anchor::reach &&
           most.z >= -head::Anchor::reach;
}

WoundSet drawn_near(WoundSet wounds, const glm::dvec3& point, std::span<const WoundReach> reaches)
{
    if (wounds.size() <= shared::WOUNDS_HERE)
        return wounds;
    std::ranges::stable_sort(wounds, {}, [&](std::uint32_t k) {
        const head::Anchor& anchor = reaches[k].anchor;
        return glm::distance(anchor.centre, point) / anchor.half_width_m;
    });
    wounds.resize(shared::WOUNDS_HERE);
    std::ranges::sort(wounds);
    return wounds;
}

WoundSet wounds_on(const head::Model& model, std::size_t first, std::span<const WoundReach> wounds)
{
    return drawn_near(wounds_reaching(model, first, wounds), ball_around(model, first).first, wounds);
}

gpu::MeshBuffer upload_mesh(const gpu::Device& device, std::span<const head::Vertex> vertices,
                            std::span<const std::uint32_t> indices, const std::string& name)
{
    static constexpr std::array<graph::VertexAttribute, 7> attributes{{
        {"position", 3, offsetof(head::Vertex, position)},
        {"normal", 3, offsetof(head::Vertex, normal)},
        {"tangent", 4, offsetof(head::Vertex, tangent)},
        {"uv", 2, offsetof(head::Vertex, uv)},
        {"occlusion", 1, offsetof(head::Vertex, occlusion)},
        {"curvature", 2, offsetof(head::Vertex, curvature)},
        {"thinness", 1, offsetof(head::Vertex, thinness)},
    }};
    static constexpr graph::VertexLayout layout{sizeof(head::Vertex), attributes};
    return {device, layout, std::as_bytes(vertices), indices, name};
}

Head upload_head(const gpu::Device& device, const head::Model& model)
{
    Head head;
    head.min = model.min;
    head.max = model.max;
    head.boxes = boxes_around(model);
    const auto keep = [&](const cv::Mat& picture, gpu::Encoding encoding, const std::string& name) {
        head.textures.push_back(
            std::make_shared<const gpu::Texture>(device, picture, encoding, picture.total() > 1, name));
        return head.textures.back().get();
    };
    head.white = keep(cv::Mat4b(1, 1, cv::Vec4b(255, 255, 255, 255)), gpu::Encoding::Linear, "white");
    // Half floats hold the decoded (0, 0, 1) exactly; 128 of 255 would tilt the normal by .3 degrees.
    cv::Mat level;
    cv::Mat4f(1, 1, cv::Vec4f(.5f, .5f, 1, 1)).convertTo(level, CV_16F);
    const gpu::Texture* flat = keep(level, gpu::Encoding::Linear, "flat normal");

    const std::uint32_t skin = head::skin_material(model);
    std::vector<HeadPart> materials;
    for (std::uint32_t i = 0; i < model.materials.size(); ++i) {
        const head::Material& material = model.materials[i];
        HeadPart part;
        part.material = i;
        part.surface = head::surface_of(model, i, skin);
        part.blend = material.alpha != head::AlphaMode::Opaque;
        part.double_sided = material.double_sided;
        part.albedo_factor = material.base_color_factor;
        part.normal_scale = material.normal_scale;
        part.albedo = material.base_color.empty()
                          ? head.white
                          : keep(material.base_color, gpu::Encoding::Srgb, material.name + " albedo");
        part.occlusion = material.occlusion.empty()
                             ? head.white
                             : keep(material.occlusion, gpu::Encoding::Linear, material.name + " occlusion");
        part.normal = flat;
        if (!material.normal.empty()) {
            cv::Mat4b normal;
            cv::cvtColor(material.normal, normal, cv::COLOR_RGB2RGBA);
            part.normal = keep(normal, gpu::Encoding::Linear, material.name + " normal");
        }
        materials.push_back(part);
    }

    for (const head::Primitive& primitive : model.primitives) {
        HeadPart part = materials[primitive.material];
        part.first_index = primitive.first_index;
        part.index_count = primitive.index_count;
        head.parts.push_back(part);
    }
    std::ranges::stable_sort(head.parts, {}, &HeadPart::blend);
    for (const HeadPart& part : head.parts)
        if (!part.blend)
            head.casters.push_back({part.first_index, part.index_count, 0});
    head.mesh = head.caster_mesh =
        std::make_shared<const gpu::MeshBuffer>(upload_mesh(device, model.vertices, model.indices, "head"));
    return head;
}

Head with_wounds(const gpu::Device& device, const Head& head, const head::Model& model,
                 std::span<const WoundReach> wounds)
{
    if (wounds.empty())
        return head;
    Head wounded = head;
    wounded.parts.clear();
    wounded.wounded.resize(wounds.size());
    std::vector<std::uint32_t> indices;
    for (const HeadPart& part : head.parts)
        append_split(model, wounds, part, indices, wounded);
    wounded.mesh = std::make_shared<const gpu::MeshBuffer>(device, *head.mesh, indices, "head with wounds");
    return wounded;
}

} // namespace passes
