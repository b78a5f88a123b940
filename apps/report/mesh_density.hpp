// The same head with more or fewer triangles, to measure the cost of triangles.
#pragma once
#include "head/model.hpp"

namespace report_command {

std::size_t triangle_count(const head::Model& model);

/// Splits each triangle into four at the midpoints of its edges; the surface does not change.
head::Model subdivided(const head::Model& model);

/// Keeps about `share` (0 to 1) of the triangles by vertex clustering (Rossignac & Borrel 1993): space is
/// divided into cubes, one vertex per cube is kept, and degenerate triangles are removed. Coarse, and it
/// distorts texture seams, but it reaches any share and cannot fail.
head::Model clustered(const head::Model& model, double share);

/// Shrinks the textures to at most `side` texels a side, so that many heads fit into a device's memory.
head::Model with_small_pictures(head::Model model, int side);

} // namespace report_command
