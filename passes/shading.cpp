#include "passes/shading.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/input_error.hpp"
#include "head/vectors.hpp"
#include "wound/optics/specular.hpp"

namespace passes {

shared::ShadingParams shading_params(const optics::Shading& shading, const base::Color& scattering_length_mm)
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
        .ambient = head::to_glm(shading.rho_d * shading.ambient),
        .fresnel_scale = static_cast<float>(optics::fresnel_scale(shading)),
        .grazing = static_cast<float>(optics::grazing_reflectance(shading)),
        .mirrored = head::to_glm(optics::fresnel_scale(shading) * shading.ambient),
        .scattering = head::to_glm(1e-3 * scattering_length_mm),
    };
}

shared::Lighting lighting(std::span<const optics::Light> lights)
{
    if (lights.size() > shared::MAX_LIGHTS)
        throw base::InputError("lights", fmt::format("there are {}", lights.size()),
                               fmt::format("use at most {}", shared::MAX_LIGHTS));
    shared::Lighting result{};
    for (const optics::Light& light : lights)
        result.light[result.count++] = {
            .position = head::to_glm(light.position),
            .kind = static_cast<shared::uint>(light.kind),
            .direction = head::to_glm(light.direction),
            .reference_distance = static_cast<float>(light.reference_distance_m),
            .strength = head::to_glm(light.strength),
            .distance_scale = static_cast<float>(light.paper_units_per_m),
        };
    return result;
}

} // namespace passes
