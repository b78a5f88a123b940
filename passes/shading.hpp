// Converts the lights and shading of wound/optics/shading.hpp to the structs of shaders/shared/shading.h.
#pragma once
#include <glm/glm.hpp>
#include <span>

#include "shaders/shared/shading.h"
#include "wound/optics/shading.hpp"

namespace passes {

/// `scattering_length_mm`: of the skin (optics/transport.hpp).
shared::ShadingParams shading_params(const optics::Shading& shading,
                                     const base::Color& scattering_length_mm = {0, 0, 0});

/// Throws base::InputError for more than shared::MAX_LIGHTS.
shared::Lighting lighting(std::span<const optics::Light> lights);

} // namespace passes
