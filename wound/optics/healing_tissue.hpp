// The tissue at a point of the wound on a given day, as layers. The reflectance table is baked from them.
//
// An injury of depth D removes the top D of the intact layers. On a later day one part of D is still missing,
// another is filled with regrown tissue, and the rest is intact again; a cover (clot, new epithelium) may lie
// on top.
#pragma once
#include "wound/optics/tissue.hpp"

namespace optics {

struct TissueDay
{
    SkinLayers intact;        // the skin of that day without the injury
    double missing_ratio = 1; // share of D that is empty
    double regrown_ratio = 0; // share of D that is filled with `regrown`; missing + regrown <= 1
    Layer regrown, cover;     // same channels as `intact`; thickness_mm of `regrown` is ignored
};

/// The paper's model: the depth is multiplied by `depth_scale` (sqrt of the unhealed ratio), and the filled
/// part is intact skin.
TissueDay restored_skin(const SkinLayers& intact, double depth_scale);

/// Layers from the top down under an injury of `injury_depth_mm`, without layers of zero thickness. The cover
/// is at most as thick as the injury is deep, so uninjured skin has none. The deepest intact layer always
/// keeps at least half its thickness.
///
/// The index of a layer that is being taken away fades into that of the layer beneath, over the last quarter
/// of its thickness, so that the colour is continuous in the depth. `keep_indices`: there is no fade, as in
/// the paper (is_the_papers()).
SkinLayers layers_at(const TissueDay& day, double injury_depth_mm, bool keep_indices = false);

/// The depth to which layers_at() clamps an injury: all layers but the last, and half of the last (at most 5
/// mm).
double deepest_injury_mm(const SkinLayers& intact);

} // namespace optics
