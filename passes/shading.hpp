// The shader's form of light and shading: the structs of shaders/shared/shading.h filled from
// wound/shading.hpp.
#pragma once
#include <glm/glm.hpp>
#include <span>

#include "shaders/shared/shading.h"
#include "wound/shading.hpp"

namespace passes {

/// `ambient`: linear radiance of the surroundings.
shared::ShadingParams shading_params(const wound::Shading& shading, const glm::vec3& ambient);

/// The first light is the key light. Throws cicatrix::InputError for more than shared::MAX_LIGHTS.
shared::Lighting lighting(std::span<const wound::Light> lights);

} // namespace passes
