#include "passes/head.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace passes {
namespace {

Surface surface_of(const engine::Model& model, std::uint32_t material, std::uint32_t skin)
{
    if (material == skin)
        return Surface::Skin;
    std::string name = model.materials[material].name;
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    const auto says = [&](const char* word) { return name.find(word) != std::string::npos; };
    if (says("brow") || says("lash") || says("hair"))
        return Surface::Hair;
    return says("eye") ? Surface::Eye : Surface::Other;
}

/// Splits a part's triangles into those that an anchor reaches and the rest, appending both to `indices`.
void append_split(const engine::Model& model, std::span<const Anchor> anchors, HeadPart part,
                  std::vector<std::uint32_t>& indices, std::vector<HeadPart>& parts)
{
    std::vector<std::uint32_t> split[2];
    for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3) {
        const std::uint32_t* corner = &model.indices[i];
        const std::array<glm::vec3, 3> corners{model.vertices[corner[0]].position,
                                               model.vertices[corner[1]].position,
                                               model.vertices[corner[2]].position};
        const bool wounded =
            part.surface == Surface::Skin &&
            std::ranges::any_of(anchors, [&](const Anchor& anchor) { return receives(anchor, corners); });
        split[wounded].insert(split[wounded].end(), corner, corner + 3);
    }
    for (const bool wounded : {false, true}) {
        if (split[wounded].empty())
            continue;
        part.first_index = std::uint32_t(indices.size());
        part.index_count = std::uint32_t(split[wounded].size());
        part.wounded = wounded;
        indices.insert(indices.end(), split[wounded].begin(), split[wounded].end());
        parts.push_back(part);
    }
}

} // namespace

std::uint32_t skin_material(const engine::Model& model)
{
    std::vector<double> area(model.materials.size(), 0.0);
    for (const engine::Primitive& primitive : model.primitives)
        for (std::uint32_t i = primitive.first_index; i + 2 < primitive.first_index + primitive.index_count;
             i += 3) {
            const glm::vec3 a = model.vertices[model.indices[i]].position,
                            b = model.vertices[model.indices[i + 1]].position,
                            c = model.vertices[model.indices[i + 2]].position;
            area[primitive.material] += glm::length(glm::cross(b - a, c - a));
        }
    return std::uint32_t(std::ranges::max_element(area) - area.begin());
}

Head upload_head(const engine::Device& device, const engine::Model& model)
{
    Head head;
    head.min = model.min;
    head.max = model.max;
    const auto keep = [&](const cv::Mat& picture, engine::Encoding encoding, const std::string& name) {
        head.textures.push_back(
            std::make_shared<const engine::Texture>(device, picture, encoding, picture.total() > 1, name));
        return head.textures.back().get();
    };
    head.white = keep(cv::Mat4b(1, 1, cv::Vec4b(255, 255, 255, 255)), engine::Encoding::Linear, "white");
    const engine::Texture* flat =
        keep(cv::Mat4b(1, 1, cv::Vec4b(128, 128, 255, 255)), engine::Encoding::Linear, "flat normal");

    const std::uint32_t skin = skin_material(model);
    std::vector<HeadPart> materials;
    for (std::uint32_t i = 0; i < model.materials.size(); ++i) {
        const engine::Material& material = model.materials[i];
        HeadPart part;
        part.surface = surface_of(model, i, skin);
        part.blend = material.alpha != engine::AlphaMode::Opaque;
        part.double_sided = material.double_sided;
        part.albedo_factor = material.base_color_factor;
        part.normal_scale = material.normal_scale;
        part.albedo = material.base_color.empty()
                          ? head.white
                          : keep(material.base_color, engine::Encoding::Srgb, material.name + " albedo");
        part.occlusion = material.occlusion.empty() ? head.white
                                                    : keep(material.occlusion, engine::Encoding::Linear,
                                                           material.name + " occlusion");
        part.normal = flat;
        if (!material.normal.empty()) {
            cv::Mat4b normal;
            cv::cvtColor(material.normal, normal, cv::COLOR_RGB2RGBA);
            part.normal = keep(normal, engine::Encoding::Linear, material.name + " normal");
        }
        materials.push_back(part);
    }

    for (const engine::Primitive& primitive : model.primitives) {
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
        std::make_shared<const engine::MeshBuffer>(device, model.vertices, model.indices, "head");
    return head;
}

Head with_wounds(const engine::Device& device, const Head& head, const engine::Model& model,
                 std::span<const Anchor> anchors)
{
    if (anchors.empty())
        return head;
    Head wounded = head;
    wounded.parts.clear();
    std::vector<std::uint32_t> indices;
    for (const HeadPart& part : head.parts)
        append_split(model, anchors, part, indices, wounded.parts);
    wounded.mesh =
        std::make_shared<const engine::MeshBuffer>(device, *head.mesh, indices, "head with wounds");
    return wounded;
}

} // namespace passes
