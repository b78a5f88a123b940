// The same head with more or fewer triangles, to see what they cost.
#pragma once
#include "head/model.hpp"

namespace report_command {

std::size_t triangle_count(const head::Model& model);

/// Each triangle in four at the middles of its edges: the surface stays exactly what it was.
head::Model subdivided(const head::Model& model);

/// About `share` (0 to 1) of the triangles, by vertex clustering (Rossignac & Borrel 1993): space is cut into
/// cubes, of each cube's vertices one is kept, triangles that lose a corner vanish. Coarse, but it reaches
/// any share and cannot fail; texture seams suffer.
head::Model clustered(const head::Model& model, double share);

/// Pictures of at most `side` texels a side, so that many heads fit into a device's memory.
head::Model with_small_pictures(head::Model model, int side);

} // namespace report_command
