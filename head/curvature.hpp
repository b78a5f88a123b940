// How strongly a head's surface bends, at its vertices.
#pragma once
#include "head/model.hpp"

namespace head {

/// Sets Vertex::curvature, 1/m: the mean of the two principal curvatures, positive where the surface is convex,
/// and their root mean square; neither exceeds 1000. It is how fast the normal turns from a vertex to its neighbours, normals being averaged over about a millimetre first, so
/// that the noise of a scan does not count. Vertices at one position get one value, whatever seams run there; at
/// an open border the neighbours on one side count. 0 where there is no area.
void compute_curvature(Model& model);

} // namespace head
