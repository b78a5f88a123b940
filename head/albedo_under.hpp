// What of a head's skin lies under a wound's patch, texel by texel: its colour, and how much of the curved
// surface the projection reaches there.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>

#include "head/model.hpp"
#include "head/placement.hpp"

namespace head {

/// The skin's linear reflectance under the patch, size x size; NaN where the projection misses the head.
cv::Mat3f albedo_under(const Model& head, std::uint32_t material, const Anchor& anchor, int size);

/// The head's surface under each texel in mm2, weighted by how much of the projection it receives: the
/// shader's share_received() (shaders/lib/wound_projection.glsl). On a plane it is the texel's own area;
/// where the head turns away it grows with 1/cosine until the projection fades. The sum of a coverage times
/// this is the area that the coverage has on the head. Overlapping layers add up, as they are all drawn.
cv::Mat1f surface_under(const Model& head, std::uint32_t material, const Anchor& anchor, int size);

/// 0..1: how much of the projection a point receives, `facing` of shaders/lib/wound_projection.glsl. `cosine`
/// between its normal and the patch's, `height` above the patch's plane in half widths.
double share_received(double cosine, double height);

} // namespace head
