#include "reference/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "head/vectors.hpp"
#include "reference/directions.hpp"
#include "reference/texture.hpp"

namespace reference {
namespace {

constexpr double nearest_m = 1e-7; // a ray does not meet the triangle that it leaves

glm::dvec3 normalize_or(const glm::dvec3& v, const glm::dvec3& otherwise)
{
    const double length = glm::length(v);
    return length > 1e-30 ? v / length : otherwise;
}

MaterialLook look_of(const head::Model& model, std::uint32_t index, std::uint32_t skin)
{
    const head::Material& material = model.materials[index];
    const head::Surface surface = head::surface_of(model, index, skin);
    return {&material, surface, material.alpha != head::AlphaMode::Opaque, material.double_sided,
            head::gloss_of(surface)};
}

/// Hanika 2021, "Hacking the shadow terminator", Ray Tracing Gems II, ch. 4: the mean of the point's
/// projections onto the tangent planes of the corners, where those lie above it.
glm::dvec3 lift(const glm::dvec3& at, const std::array<glm::dvec3, 3>& corners,
                const std::array<glm::dvec3, 3>& normals, const glm::dvec3& weights)
{
    glm::dvec3 lifted = at;
    for (int k = 0; k < 3; ++k) {
        const double below = glm::dot(at - corners[std::size_t(k)], normals[std::size_t(k)]);
        lifted -= weights[k] * std::min(below, 0.0) * normals[std::size_t(k)];
    }
    return lifted;
}

} // namespace

glm::dvec3 bent_to_viewer(const glm::dvec3& normal, const glm::dvec3& to_viewer)
{
    constexpr double least = 0.01;
    const double cosine = glm::dot(normal, to_viewer);
    return cosine >= least ? normal : normalize_or(normal + (least - cosine) * to_viewer, to_viewer);
}

glm::dmat3 tangent_frame(const glm::dvec3& normal, const glm::dvec4& tangent)
{
    glm::dvec3 t = normalize_or(glm::dvec3(tangent), normal);
    t -= normal * glm::dot(normal, t);
    t = glm::dot(t, t) > 1e-6 ? glm::normalize(t) : frame_about(normal)[0];
    return {t, glm::cross(normal, t) * (tangent.w < 0 ? -1.0 : 1.0), normal};
}

Surfaces::Surfaces(const scene::LoadedScene& scene, const DayWounds& wounds)
    : scene_(scene), wounds_(wounds), model_(*scene.head->model), normal_map_(scene.scene.shading.normal_map),
      all_(model_, head::Bvh::Triangles::All)
{
    for (std::uint32_t i = 0; i < model_.materials.size(); ++i) {
        looks_.push_back(look_of(model_, i, scene.head->skin));
        masked_ |= model_.materials[i].alpha == head::AlphaMode::Mask;
    }
}

std::optional<head::Hit> Surfaces::seen(const glm::dvec3& origin, const glm::dvec3& direction,
                                        double tmin) const
{
    return all_.nearest(origin, direction, tmin, std::numeric_limits<double>::infinity(), head::Facing::Both,
                        [&](const head::Hit& hit) { return hit.front || look(hit).double_sided; });
}

std::optional<head::Hit> Surfaces::met(const glm::dvec3& origin, const glm::dvec3& direction) const
{
    const auto solid = [&](const head::Hit& hit) { return !look(hit).blended; };
    constexpr double endless = std::numeric_limits<double>::infinity();
    return masked_
               ? scene_.head->bvh->nearest(origin, direction, nearest_m, endless, head::Facing::Both, solid)
               : scene_.head->bvh->nearest(origin, direction, nearest_m, endless);
}

bool Surfaces::reached_by(const optics::Light& light, const optics::LightSample& sample,
                          const SurfacePoint& point) const
{
    const auto solid = [&](const head::Hit& hit) { return !look(hit).blended; };
    const double reach = light.kind == optics::LightKind::Directional
                             ? std::numeric_limits<double>::infinity()
                             : sample.distance_m;
    const glm::dvec3 towards = head::to_glm(sample.direction);
    return !(masked_ ? scene_.head->bvh->any(point.lifted, towards, reach, solid)
                     : scene_.head->bvh->any(point.lifted, towards, reach));
}

SurfacePoint Surfaces::point(const head::Hit& hit) const
{
    std::array<const head::Vertex*, 3> vertices;
    std::array<glm::dvec3, 3> corners, normals;
    const glm::dvec3 weights(1 - hit.u - hit.v, hit.u, hit.v);
    const double side = hit.front ? 1 : -1;
    SurfacePoint point;
    glm::dvec2 uv(0);
    for (std::size_t k = 0; k < 3; ++k) {
        vertices[k] = &model_.vertices[model_.indices[hit.triangle + k]];
        corners[k] = glm::dvec3(vertices[k]->position);
        normals[k] = side * glm::dvec3(vertices[k]->normal);
        const double weight = weights[int(k)];
        point.at += weight * corners[k];
        point.smooth += weight * normals[k];
        point.tangent += weight * glm::dvec4(vertices[k]->tangent);
        uv += weight * glm::dvec2(vertices[k]->uv);
    }
    point.flat = side * glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    point.smooth = normalize_or(point.smooth, point.flat);
    point.lifted = lift(point.at, corners, normals, weights) + 1e-6 * point.flat;
    point.look = &looks_[hit.material];

    const head::Material& material = *point.look->material;
    const glm::dvec4 albedo = sample_srgb(material.base_color, uv) * glm::dvec4(material.base_color_factor);
    point.alpha = point.look->blended ? albedo.a : 1;
    point.normal = point.smooth;
    if (normal_map_ && !material.normal.empty()) {
        const glm::dvec3 mapped = sample_linear(material.normal, uv) * 2.0 - 1.0;
        const glm::dvec3 scaled(glm::dvec2(mapped) * double(material.normal_scale), std::max(mapped.z, 0.05));
        point.normal = normalize_or(tangent_frame(point.smooth, point.tangent) * scaled, point.smooth);
    }
    point.skin.skin = {{albedo.r, albedo.g, albedo.b}, head::to_cv(point.normal)};
    if (point.look->surface == head::Surface::Skin) {
        point.skin = wounds_.at(point.at, point.smooth, point.skin.skin);
        point.normal = head::to_glm(point.skin.skin.normal);
    }
    return point;
}

SurfacePoint Surfaces::point(const SurfaceHit& hit) const
{
    return point(head::Hit{.triangle = hit.triangle,
                           .primitive = 0,
                           .material = scene_.head->skin,
                           .front = true,
                           .distance = hit.distance,
                           .u = hit.barycentric.x,
                           .v = hit.barycentric.y});
}

std::optional<SurfaceHit> Surfaces::first_on_ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                                 double reach) const
{
    const std::uint32_t skin = scene_.head->skin;
    const auto hit =
        scene_.head->bvh->nearest(origin, direction, nearest_m, reach, head::Facing::Both,
                                  [&](const head::Hit& found) { return found.material == skin; });
    if (!hit)
        return std::nullopt;
    std::array<glm::dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
        corners[k] = glm::dvec3(model_.vertices[model_.indices[hit->triangle + k]].position);
    return SurfaceHit{.distance = hit->distance,
                      .normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0])),
                      .triangle = hit->triangle,
                      .barycentric = {hit->u, hit->v}};
}

} // namespace reference
