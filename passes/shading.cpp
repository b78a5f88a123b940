#include "passes/shading.hpp"

#include <algorithm>
#include <cmath>

#include "wound/input_error.hpp"

namespace passes {

static_assert(shared::WARD_PUBLISHED == static_cast<std::uint32_t>(wound::WardModel::Published));
static_assert(shared::WARD_DUER == static_cast<std::uint32_t>(wound::WardModel::WardDuer));
static_assert(shared::WARD_BOUNDED == static_cast<std::uint32_t>(wound::WardModel::Bounded));
static_assert(shared::TRANSLUCENCY_PUBLISHED ==
              static_cast<std::uint32_t>(wound::TranslucencyModel::Published));
static_assert(shared::TRANSLUCENCY_BOUNDED == static_cast<std::uint32_t>(wound::TranslucencyModel::Bounded));
static_assert(shared::BLEND_PUBLISHED == static_cast<std::uint32_t>(wound::BlendModel::Published));
static_assert(shared::BLEND_CORRECTED == static_cast<std::uint32_t>(wound::BlendModel::Corrected));
static_assert(shared::LIGHT_DIRECTIONAL == static_cast<std::uint32_t>(wound::LightKind::Directional));
static_assert(shared::LIGHT_POINT == static_cast<std::uint32_t>(wound::LightKind::Point));
static_assert(shared::LIGHT_POINT_WITHOUT_FALLOFF ==
              static_cast<std::uint32_t>(wound::LightKind::PointWithoutFalloff));

namespace {

glm::vec3 to_glm(const cv::Vec3d& v)
{
    return glm::vec3(glm::dvec3(v[0], v[1], v[2]));
}

} // namespace

shared::ShadingParams shading_params(const wound::Shading& shading, const glm::vec3& ambient)
{
    return {
        .rho_d = static_cast<float>(shading.rho_d),
        .rho_ts = static_cast<float>(shading.rho_ts),
        .rho_s = static_cast<float>(shading.rho_s),
        .alpha = static_cast<float>(shading.alpha),
        .beta = static_cast<float>(shading.beta),
        .gamma = static_cast<float>(shading.gamma),
        .translucency_bound_4 =
            static_cast<float>(std::pow(std::max(shading.translucency_bound(), 1e-9), -4)),
        .slope = glm::vec2(glm::dvec2(shading.alpha_x, shading.alpha_y)),
        .ambient = ambient,
    };
}

shared::Lighting lighting(std::span<const wound::Light> lights)
{
    if (lights.size() > shared::MAX_LIGHTS)
        throw cicatrix::InputError("lights", fmt::format("there are {}", lights.size()),
                                   fmt::format("use at most {}", shared::MAX_LIGHTS));
    shared::Lighting result{};
    for (const wound::Light& light : lights)
        result.light[result.count++] = {
            .position = to_glm(light.position),
            .kind = static_cast<shared::uint>(light.kind),
            .direction = to_glm(light.direction),
            .reference_distance = static_cast<float>(light.reference_distance_m),
            .strength = to_glm(light.strength),
            .distance_scale = static_cast<float>(light.translucency_distance.scale),
            .distance_offset = static_cast<float>(light.translucency_distance.offset),
        };
    return result;
}

} // namespace passes
