// Scenes made by code, whose light is known by a formula.
#pragma once
#include <numbers>

#include "reference/traceable.hpp"
#include "scene/loaded_scene.hpp"

namespace scenes {

/// Triangles of a ball, skin unless it is given another material.
inline void add_ball(head::Model& model, const glm::vec3& centre, float radius, std::uint32_t material = 0,
                     std::uint32_t rings = 96)
{
    const auto first = std::uint32_t(model.vertices.size()),
               first_index = std::uint32_t(model.indices.size());
    const std::uint32_t sectors = 2 * rings;
    for (std::uint32_t j = 0; j <= rings; ++j)
        for (std::uint32_t i = 0; i <= sectors; ++i) {
            const float down = std::numbers::pi_v<float> * float(j) / float(rings),
                        around = 2 * std::numbers::pi_v<float> * float(i) / float(sectors);
            const glm::vec3 normal(std::sin(down) * std::sin(around), std::cos(down),
                                   std::sin(down) * std::cos(around));
            model.vertices.push_back(
                {centre + radius * normal, normal, {std::cos(around), 0, -std::sin(around), 1}, {}});
        }
    for (std::uint32_t j = 0; j < rings; ++j)
        for (std::uint32_t i = 0; i < sectors; ++i) {
            const std::uint32_t a = first + j * (sectors + 1) + i, below = a + sectors + 1;
            model.indices.insert(model.indices.end(), {a, below, a + 1, a + 1, below, below + 1});
        }
    model.primitives.push_back({first_index, std::uint32_t(model.indices.size()) - first_index, material});
}

/// A rectangle that faces +z.
inline void add_card(head::Model& model, const glm::vec3& centre, float width, std::uint32_t material)
{
    const auto first = std::uint32_t(model.vertices.size()),
               first_index = std::uint32_t(model.indices.size());
    for (const glm::vec2 corner : {glm::vec2(-1, 1), {-1, -1}, {1, -1}, {1, 1}})
        model.vertices.push_back(
            {centre + glm::vec3(width / 2 * corner, 0), {0, 0, 1}, {1, 0, 0, 1}, 0.5f * corner + 0.5f});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
        model.indices.push_back(first + i);
    model.primitives.push_back({first_index, 6, material});
}

inline head::Material plain(const char* name, const glm::vec4& linear_color)
{
    head::Material material;
    material.name = name;
    material.base_color_factor = linear_color;
    return material;
}

/// The model as a scene without wounds, lights and ambient light, of the given diffuse share. It mirrors lights alone.
inline scene::LoadedScene scene_of(head::Model model, double rho_d = 1)
{
    head::update_bounds(model);
    auto head = std::make_shared<scene::LoadedHead>();
    head->bvh = std::make_shared<const head::Bvh>(model);
    head->face = head::find_face(model);
    head->key = "made by a test";
    head->model = std::make_shared<const head::Model>(std::move(model));
    scene::LoadedScene loaded;
    loaded.head = head;
    loaded.scene.wounds.clear();
    loaded.scene.shading.ambient = {0, 0, 0};
    loaded.scene.shading.rho_d = rho_d;
    loaded.scene.shading.specular_model = optics::SpecularModel::Ward;
    loaded.tissue = optics::table1();
    loaded.complete = true;
    return loaded;
}

/// A scene's tracer.
struct Tracer
{
    reference::Traceable scene;

    Tracer(const scene::LoadedScene& of, const reference::Levels& levels, double day = 0)
        : scene(of, levels, day)
    {
    }

    struct Mean
    {
        base::Color light{0, 0, 0};
        double alpha = 0, error = 0; // of green
    };
    Mean along(const glm::dvec3& origin, const glm::dvec3& direction, int samples) const
    {
        Mean mean;
        double squares = 0;
        for (int i = 0; i < samples; ++i) {
            reference::Random random(5, 0, std::uint64_t(i));
            const reference::Radiance one = scene.tracer.along(origin, direction, random);
            const base::Color light = one.diffuse + one.specular;
            mean.light += light / samples;
            mean.alpha += one.alpha / samples;
            squares += light[1] * light[1] / samples;
        }
        mean.error = std::sqrt(std::max(0.0, squares - mean.light[1] * mean.light[1]) / samples);
        return mean;
    }
};

} // namespace scenes
