// What a graph says about itself: who touches which image how, and whether the declaration makes sense.
#pragma once
#include "engine/graph/access.hpp"
#include "engine/graph/graph.hpp"

#include <string>
#include <vector>

namespace graph {

struct ImageAccess
{
    ImageId image;
    Usage usage;
};

/// Everything a pass does to images, in the order of its
/// declaration: what it samples first, then what it writes.
std::vector<ImageAccess> accesses(const Pass& pass);

/// Images, passes and bindings that cannot be right, one line
/// each: "pass forward: samples lut, which nobody writes".
std::vector<std::string> check_graph(const Graph& graph);

/// Indices of the passes, every writer before its readers,
/// otherwise as declared. Passes on a cycle are left out.
std::vector<std::uint32_t> order_passes(const Graph& graph);

/// Throws std::logic_error with all lines, or does nothing when there are none.
void throw_if_any(const std::vector<std::string>& problems);

} // namespace graph
