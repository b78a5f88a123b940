// Fits a prepared patch to the face it is put on.
//
// Around the wound the photograph's skin becomes the face's skin: a smooth log-ratio of the two is
// interpolated from points where both show healthy skin (gradient-domain cloning), so that the inflamed rim
// keeps its contrast on any skin tone. The open bed keeps its colours, because blood is as red on dark skin
// as on light; only the photo's white balance and exposure, estimated from healthy skin and blood, are
// corrected. Opacity falls to 0 in a short band, before anything that is not skin.
#pragma once
#include "wound/patch.hpp"

namespace wound {

/// `patch.opacity`: 0 where the photograph has no data (empty: data everywhere). `face_skin`: the face's
/// linear reflectance in patch coordinates, square, of any size (pores and stubble are used from half the
/// patch's size on); NaN where the projection misses the face; empty if unknown, which keeps the photo's skin
/// tone. The result's color and opacity contain no NaN for any input; mask and depth are unchanged.
Patch match_to_skin(const Patch& patch, const cv::Mat3f& face_skin);

} // namespace wound
