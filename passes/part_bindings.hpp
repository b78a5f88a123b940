// What every pass that computes a point of the head (shaders/lib/skin_inputs.glsl) binds.
#pragma once
#include <span>
#include <vector>

#include "engine/graph/graph.hpp"
#include "passes/forward.hpp"
#include "shaders/shared/part.h"

namespace passes {

shared::Part part_params(const HeadPart& part, optics::Shading shading);

/// Albedo, normal and occlusion of the part and those of `wounds` that are in `set` (HeadPart::wounds).
void bind_part(graph::Graph& graph, graph::Draw& draw, const Head& head, const HeadPart& part,
               const WoundSet& set, std::span<const ForwardWound> wounds);

/// Those of `wounds` that are in `set`.
std::vector<ForwardWound> of_set(const WoundSet& set, std::span<const ForwardWound> wounds);

} // namespace passes
