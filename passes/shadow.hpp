// Shadow map of the key light: the depth of the head seen from the light. The pass runs only when the light
// or the head has changed; the graph drops it when nothing samples the depth. shaders/lib/shadow.glsl
// computes the visibility.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/graph/graph.hpp"
#include "head/model.hpp"
#include "shaders/shared/shadow.h"
#include "wound/optics/shading.hpp"

namespace passes {

inline constexpr std::uint32_t shadow_size = 1024; // texels; .55 mm on a bust: edges are about 1.7 mm soft

/// The light's frustum (parallel for a directional light) that tightly encloses the box. None when the light
/// is inside the box or too near for one shadow map to cover it: such a light casts no shadow.
std::optional<shared::Shadow> fit_shadow(const optics::Light& light, const glm::vec3& box_min,
                                         const glm::vec3& box_max);

/// Depth of the given primitives, D32, seen by `shadow`. Omit primitives that transmit light, such as lashes.
graph::ImageId add_shadow(graph::Graph& graph, const shared::Shadow& shadow, const graph::Mesh& mesh,
                          std::span<const head::Primitive> casters);

} // namespace passes
