// Derives from a declared graph the image accesses of each pass, the declaration's mistakes, and an order.
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

/// All image accesses of a pass in order of declaration:
/// first the sampled images, then the written ones.
std::vector<ImageAccess> accesses(const Pass& pass);

/// Mistakes in images, passes and bindings, one line each:
/// "pass forward: samples lut, which no pass writes".
std::vector<std::string> check_graph(const Graph& graph);

/// Indices of the passes: every writer before its readers, otherwise
/// in order of declaration. Passes on a cycle are left out.
std::vector<std::uint32_t> order_passes(const Graph& graph);

/// Throws std::logic_error with all lines unless there are none.
void throw_if_any(const std::vector<std::string>& problems);

} // namespace graph
