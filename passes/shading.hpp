// Converts the lights and shading of wound/optics/shading.hpp to the structs of shaders/shared/shading.h.
#pragma once
#include <glm/glm.hpp>
#include <span>

#include "shaders/shared/shading.h"
#include "wound/optics/shading.hpp"

namespace passes {

shared::ShadingParams shading_params(const optics::Shading& shading);

/// Throws base::InputError for more than shared::MAX_LIGHTS.
shared::Lighting lighting(std::span<const optics::Light> lights);

} // namespace passes
