// One backward warp for the compute shader: a header, and values from values[first] on in an array of vec2
// that several warps may share. The values depend on the model:
//   radial    `count` radii of the hull, in .x, at equal angles from -pi
//   grid      `count` node positions (x, y along each axis), then count x count day-0 coordinates, row by row
//   dense, composed   `steps` thin-plate steps, today's first: 3 affine coefficients and `count` pairs
//             (centre, weight)
#ifndef CICATRIX_SHARED_WARP_H
#define CICATRIX_SHARED_WARP_H
#include "glsl.h"

#ifdef __cplusplus
namespace shared {
#endif

struct WarpHeader
{
    vec2 center;        // the fixed point, in patch coordinates ("centroid" is a GLSL keyword)
    float scale;        // sqrt(area ratio)
    float grid_epsilon; // patch units: the grid is finest within this distance of `center`
    uint model;          // wound::WarpModel
    uint first;         // index into the array of values
    uint count;
    uint steps;
};

#ifdef __cplusplus
} // namespace shared
#endif

#endif
