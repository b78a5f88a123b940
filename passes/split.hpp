// Combines the left part of one picture and the right part of another, to compare two settings of a view.
#pragma once
#include "engine/graph/graph.hpp"

namespace passes {

/// Adds one pass. Both pictures and the result are encoded (RGBA8) and of the same size. `divider`: share of
/// the width, 0 to 1, that shows `left`; rounded to whole pixels.
graph::ImageId add_split(graph::Graph& graph, graph::ImageId left, graph::ImageId right, double divider);

} // namespace passes
