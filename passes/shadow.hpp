// Cast shadow of the key light: the depth of the head seen from the light. The pass runs when light or head
// have changed; the graph drops it when nothing samples the depth. shaders/lib/shadow.glsl turns it into
// visibility.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/graph/graph.hpp"
#include "head/model.hpp"
#include "shaders/shared/shadow.h"
#include "wound/optics/shading.hpp"

namespace passes {

inline constexpr std::uint32_t shadow_size = 512; // texels; 0.7 mm on a head: an edge is about 2 mm soft

/// The frustum (parallel for a directional light) that just holds the box. Nothing when the light stands in
/// or too near the box for one picture to hold all of it: such a light casts no shadow here.
std::optional<shared::Shadow> fit_shadow(const optics::Light& light, const glm::vec3& box_min,
                                         const glm::vec3& box_max);

/// Depth of the given primitives, D32, seen by `shadow`. Leave out what light passes through, such as lashes.
graph::ImageId add_shadow(graph::Graph& graph, const shared::Shadow& shadow, const graph::Mesh& mesh,
                          std::span<const head::Primitive> casters);

} // namespace passes
