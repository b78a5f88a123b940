// Light that is kept on the skin. Two passes on its atlas: what the skin is like, run again when a wound, the
// day or the tissue changes, and there only where the wounds are; and the light that leaves it diffusely, run
// again when the lights change too. A camera does not concern them.
#pragma once
#include <span>

#include "engine/graph/graph.hpp"
#include "passes/forward.hpp"
#include "passes/skin.hpp"
#include "shaders/shared/skin.h"

namespace passes {

struct SkinLight
{
    graph::ImageId
        light; // rgb: root of the diffuse light over code.white; a: share of the first light that arrives
    graph::ImageId normal; // rgb: normal of the head, coded; a: share of the second light
    graph::ImageId
        gloss; // wetness, tautness, slope variance, occlusion by the wound's hollow (lib/skin_code.glsl)
    shared::LightCode code;
    const Skin& skin;
    std::span<const ForwardWound> wounds; // on the skin, whether a camera sees them or not
    graph::Region wounded;                // of these images: what a new day can change
};

/// Whether the skin's passes can draw this: the transport does not depend on the vertices, the highlight is
/// equal in all directions, and no light but the first two casts a shadow.
bool can_keep_light(const optics::Shading& shading, const Shadows& shadows);

/// `input.wounds`: all of the head's, seen or not. `scale`: of the atlas, a power of two.
SkinLight add_skin_light(graph::Graph& graph, const ForwardInput& input, const Skin& skin, double scale,
                         const optics::Shading& shading, float exposure_stops);

} // namespace passes
