#include "head/materials.hpp"

#include <algorithm>
#include <cctype>

namespace head {

Gloss gloss_of(Surface surface)
{
    switch (surface) {
    case Surface::Skin:
        return {};
    case Surface::Eye: // wet and smooth: half the specular reflectance in a lobe a fifth as wide
        return {.specular = .5, .slope = .2};
    case Surface::Hair:
    case Surface::Other:
        break;
    }
    return {.specular = 0};
}

std::uint32_t skin_material(const Model& model)
{
    std::vector<double> area(model.materials.size(), 0.0);
    for (const Primitive& primitive : model.primitives)
        for (std::uint32_t i = primitive.first_index; i + 2 < primitive.first_index + primitive.index_count;
             i += 3) {
            const glm::vec3 a = model.vertices[model.indices[i]].position,
                            b = model.vertices[model.indices[i + 1]].position,
                            c = model.vertices[model.indices[i + 2]].position;
            area[primitive.material] += glm::length(glm::cross(b - a, c - a));
        }
    return std::uint32_t(std::ranges::max_element(area) - area.begin());
}

Surface surface_of(const Model& model, std::uint32_t material, std::uint32_t skin)
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

} // namespace head
