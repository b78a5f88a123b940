// What a pass of a scheduled frame has to do, counted from its declaration: the same on every machine.
#pragma once
#include "engine/graph/schedule.hpp"

#include <cstdint>

namespace graph {

struct PassWork
{
    std::uint64_t texels = 0;        // that it writes, of one of its images; they all have the same size
    double refreshed = 0;            // these over all texels of the image, 0..1
    std::uint64_t bytes_written = 0; // to its declared images that are stored
    std::uint64_t maps_sampled = 0;  // images that its draws or its dispatch bind to sample, each once a draw
};

/// Nothing for a pass that does not run.
PassWork work_of(const Graph& graph, const PassPlan& planned);

/// Texels that a running pass writes over the texels of its images, 0..1.
double refreshed_share(const Graph& graph, const PassPlan& planned);

} // namespace graph
