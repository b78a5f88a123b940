// Fits a prepared patch to the face it is put on.
//
// Around the wound the photograph's skin becomes the face's skin: a smooth log-ratio between the two is
// spread from where both show healthy skin (gradient-domain cloning), so that the inflamed rim keeps its
// contrast to healthy skin on any skin tone. The open bed keeps its own colours, for blood is as red on dark
// skin as on light; it only loses the photo's white balance and exposure as far as its healthy skin betrays
// them. Opacity ends within a short band, before anything that is not skin.
#pragma once
#include "wound/patch.hpp"

namespace wound {

/// `patch.opacity`: 0 where the photograph has no data (or empty: data everywhere). `face_skin`: the face's
/// own linear reflectance in patch coordinates, square, of any size (its pores and stubble are kept from half
/// the patch's size on); NaN where the projection misses the face; empty where unknown, which leaves the
/// photo's skin tone. The result's color and opacity are free of NaN whatever comes in; mask and depth are as
/// given.
Patch match_to_skin(const Patch& patch, const cv::Mat3f& face_skin);

} // namespace wound
