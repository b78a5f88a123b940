// A schedule as text and as a Graphviz graph, for `cicatrix graph`.
#pragma once
#include "engine/graph/schedule.hpp"

#include <string>

namespace graph {

/// Passes in order with state, reason, images read and written,
/// barriers; then images with size, format, lifetime.
std::string plan_text(const Graph& graph, const Plan& plan);

/// For `dot -Tsvg`: boxes are passes (dashed: skipped, dotted: culled), ellipses images.
std::string plan_dot(const Graph& graph, const Plan& plan);

} // namespace graph
