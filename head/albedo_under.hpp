// The head's skin under each texel of a wound's patch: its colour, and the area of curved surface that the
// projection reaches.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>

#include "head/model.hpp"
#include "head/placement.hpp"

namespace head {

/// The skin's linear reflectance under the patch, size x size; NaN where the projection misses the head.
cv::Mat3f albedo_under(const Model& head, std::uint32_t material, const Anchor& anchor, int size);

/// The head's surface under each texel in mm2, weighted by share_received(). On a plane it equals the texel's
/// area; on oblique skin it grows with 1/cosine until the projection fades. The sum of coverage times this
/// value is the covered area on the head. Overlapping layers of skin add up, because all of them are drawn.
cv::Mat1f surface_under(const Model& head, std::uint32_t material, const Anchor& anchor, int size);

/// Share of the projection that a point receives, 0..1: `facing` of shaders/lib/wound_projection.glsl.
/// `cosine`: between the point's normal and the patch's. `height`: above the patch's plane, in half widths.
double share_received(double cosine, double height);

} // namespace head
