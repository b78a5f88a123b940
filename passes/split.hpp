// Two pictures side by side in one, to compare two settings of the same view.
#pragma once
#include "engine/graph/graph.hpp"

namespace passes {

/// Adds one pass. Both are encoded pictures (RGBA8) of one size; so is the result. `divider`: the share of
/// the width, 0 to 1, that shows `left`, in whole pixels.
graph::ImageId add_split(graph::Graph& graph, graph::ImageId left, graph::ImageId right, double divider);

} // namespace passes
