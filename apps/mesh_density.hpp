// The same head with more or fewer triangles, to see what they cost.
#pragma once
#include "engine/model.hpp"

namespace app {

std::size_t triangle_count(const engine::Model& model);

/// Each triangle in four at the middles of its edges: the surface stays exactly what it was.
engine::Model subdivided(const engine::Model& model);

/// About `share` (0 to 1) of the triangles, by vertex clustering (Rossignac & Borrel 1993): space is cut into
/// cubes, of each cube's vertices one is kept, triangles that lose a corner vanish. Coarse, but it reaches
/// any share and cannot fail; texture seams suffer.
engine::Model clustered(const engine::Model& model, double share);

/// Pictures of at most `side` texels a side, so that many heads fit into a device's memory.
engine::Model with_small_pictures(engine::Model model, int side);

} // namespace app
