// Light that is kept on the skin. Two passes on its atlas: what the skin is like, run again when a wound, the
// day or the tissue changes, and there only where the wounds are; and the light that leaves it diffusely, run
// again when the lights change too. A camera does not concern them. With transport `diffused` it is the light
// that the skin receives, for passes/diffusion.hpp.
#pragma once
#include <span>

#include "engine/graph/graph.hpp"
#include "passes/forward.hpp"
#include "passes/skin.hpp"
#include "shaders/shared/skin.h"

namespace passes {

struct SkinLight
{
    /// rgb: root of the diffuse light over code.white, or the light that is received, per reflectance; a:
    /// share of the first light that arrives.
    graph::ImageId light;
    graph::ImageId normal; // rgb: normal of the head, coded; a: share of the second light
    graph::ImageId
        gloss; // wetness, tautness, slope variance, occlusion by the wound's hollow (lib/skin_code.glsl)
    graph::ImageId albedo; // rgb: root of C of eq. (4)
    shared::LightCode code;
    graph::Region wounded; // of these images: what a new day can change
    double reach_m = 0;    // how far from a wound it can change something
};

/// Whether a camera's picture can be made of it: the transport depends neither on vertices nor on the camera,
/// the highlight is equal in all directions, and no light but the first two casts a shadow.
bool can_keep_light(const optics::Shading& shading, const Shadows& shadows);

/// `input.wounds`: all of the head's, seen or not. `scale`: of the atlas, a power of two. With input.around
/// the light has spread.
SkinLight add_skin_light(graph::Graph& graph, const ForwardInput& input, const Skin& skin, double scale,
                         const optics::Shading& shading, float exposure_stops);

/// The same light before it has spread: SkinLight::light is what the skin receives, per reflectance. For
/// transport `diffused`.
SkinLight add_received_light(graph::Graph& graph, const ForwardInput& input, const Skin& skin, double scale,
                             const optics::Shading& shading);

} // namespace passes
