// Shadow maps of the lights: depth of the head seen from each, side by side in one image. The pass runs only
// when a light, the head, or the part of it that is in view has changed; the graph drops it when nothing
// samples the depth. shaders/lib/shadow.glsl computes the visibility.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/graph/graph.hpp"
#include "head/model.hpp"
#include "passes/in_view.hpp"
#include "shaders/shared/shading.h"
#include "shaders/shared/shadow.h"
#include "wound/optics/shading.hpp"

namespace passes {

/// Texels, of a light: narrowed to what a camera sees, and of all the head.
inline constexpr std::uint32_t shadow_size = 1024, kept_shadow_size = 2048;

/// The light's frustum (parallel for a directional light) that tightly encloses the box, narrowed to what the
/// camera can see (`seen`, boxes in it; none: all of it). It keeps all casters between light and `seen`. Its
/// width is one of a few, and its place moves by whole texels: while the camera moves a little it stays the
/// same, and then shadows do not crawl. None when the light is inside the box or too near for one shadow map
/// to cover it: such a light casts no shadow.
std::optional<shared::Shadow> fit_shadow(const optics::Light& light, const glm::vec3& box_min,
                                         const glm::vec3& box_max, std::span<const Bounds> seen = {},
                                         std::uint32_t size = shadow_size);

struct Shadows
{
    shared::Shadow
        lights[shared::MAX_LIGHTS]{}; // of the lights that cast a shadow; the shaders' uniform block
    std::uint32_t casting = 0;        // bit i: light i casts a shadow
};
Shadows fit_shadows(std::span<const optics::Light> lights, const glm::vec3& box_min, const glm::vec3& box_max,
                    std::span<const Bounds> seen, std::uint32_t size = shadow_size);

/// Depth of the given primitives, D32, seen by each light that casts a shadow; there must be one. Omit
/// primitives that transmit light, such as lashes. `name`: of the pass.
graph::ImageId add_shadows(graph::Graph& graph, const std::string& name, const Shadows& shadows,
                           const graph::Mesh& mesh, std::span<const head::Primitive> casters,
                           std::uint32_t size = shadow_size);

} // namespace passes
