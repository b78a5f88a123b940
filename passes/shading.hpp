// The shader's form of light and shading: the structs of shaders/shared/shading.h filled from
// wound/optics/shading.hpp.
#pragma once
#include <glm/glm.hpp>
#include <span>

#include "shaders/shared/shading.h"
#include "wound/optics/shading.hpp"

namespace passes {

shared::ShadingParams shading_params(const optics::Shading& shading);

/// The first light is the key light. Throws base::InputError for more than shared::MAX_LIGHTS.
shared::Lighting lighting(std::span<const optics::Light> lights);

} // namespace passes
