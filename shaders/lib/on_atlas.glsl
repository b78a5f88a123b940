// Vertices that are drawn on the skin's atlas.
#ifndef LIB_ON_ATLAS_GLSL
#define LIB_ON_ATLAS_GLSL
#include "shared/skin.h"

// place: share of the image's size. outward: direction of a skirt, 0 for the skin itself.
vec4 on_atlas(AtlasDraw draw, vec2 place, vec2 outward) { return vec4((place + outward * draw.skirt) * 2.0 - 1.0, 0.0, 1.0); }

// The same of a draw of the skin's surface; all in units.
vec4 on_atlas(SurfaceDraw draw, vec2 place, vec2 outward)
{
    return vec4((place + outward * draw.skirt) / draw.size * 2.0 - 1.0, 0.0, 1.0);
}

bool outside_tile(SurfaceDraw draw, vec2 texel) { return any(lessThan(texel, draw.low)) || any(greaterThan(texel, draw.high)); }
bool outside_tile(AtlasDraw draw, vec2 texel) { return any(lessThan(texel, draw.low)) || any(greaterThan(texel, draw.high)); }

#endif
