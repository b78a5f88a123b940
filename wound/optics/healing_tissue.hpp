// What tissue stands at a place of the wound on a given day, as layers. The reflectance table is baked from
// this.
//
// An injury of depth D took the top D of the intact layers. On a later day a part of D is still missing, a
// part is filled with regrown tissue, and the rest is as it was before the injury; over all of it may lie a
// cover (clot, new epithelium).
#pragma once
#include "wound/optics/tissue.hpp"

namespace optics {

struct TissueDay
{
    SkinLayers intact;        // the skin without the injury, that day
    double missing_ratio = 1; // of D: nothing is there
    double regrown_ratio = 0; // of D: filled with `regrown`; missing + regrown <= 1
    Layer regrown, cover; // same channels as intact; the cover's thickness is its own, regrown's is not used
};

/// The paper's reading: the depth shrinks by `depth_scale` (sqrt of the unhealed ratio) and what is filled is
/// skin again.
TissueDay restored_skin(const SkinLayers& intact, double depth_scale);

/// Layers from the top down where the injury took `injury_depth_mm`; layers of no thickness are left out. The
/// cover is no thicker than the injury was deep, so that nothing shows where there was none. The deepest
/// intact layer is always there and keeps at least half its thickness.
SkinLayers layers_at(const TissueDay& day, double injury_depth_mm);

/// The deepest injury that still changes anything: all layers but the last, and half of that one (at most 5
/// mm).
double deepest_injury_mm(const SkinLayers& intact);

} // namespace optics
