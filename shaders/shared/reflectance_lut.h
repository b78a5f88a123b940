// The reflectance table: the parameters of its bake, and the mapping of its texels to injury depth and day,
// for baker and sampler.
#ifndef SHARED_REFLECTANCE_LUT_H
#define SHARED_REFLECTANCE_LUT_H
#include "glsl.h"
#ifdef __cplusplus
#include <cmath>
#define SHARED_FUNCTION inline
namespace shared {
using std::sqrt;
#define CONSTANT constexpr uint
#else
#define SHARED_FUNCTION
#define CONSTANT const uint
#endif

// The table has two parts of equal height, one above the other. Bilinear filtering never mixes them, because
// the axes end at texel centres.
CONSTANT LUT_OPEN = 0;    // the open bed
CONSTANT LUT_COVERED = 1; // tissue covered by new epithelium: the ring around the bed, and the scar
CONSTANT LUT_PARTS = 2;

struct LutLayer
{
    float g;
    float n;
    float thickness_mm; // of an intact layer or the cover
};

// Coefficients of a layer at three of the tissue's channels. A tissue has one band per three channels.
struct LutBand
{
    vec3 sigma_a;         // mm^-1
    vec3 sigma_s_reduced; // mm^-1
};

// One row of the table. The layers are: cover, regrown tissue, then the intact layers from top to bottom.
struct LutDay
{
    float missing_ratio; // empty share of the injury's depth
    float regrown_ratio; // share of the injury's depth that regrown tissue fills
};

// Ranges of the table's axes: u is the injury's depth on day 0, v the day.
struct LutAxes
{
    float deepest_mm;
    float last_day;
};

struct LutParameters
{
    LutAxes axes;
    float n_above;
    float n_below;
    uint layers_per_day; // including cover and regrown tissue
    uint bands;
};

// Both axes are quadratic, so that the thin upper layers and the first days get most texels. The ends lie on
// texel centres.
SHARED_FUNCTION float lut_value(float texel, float size, float last)
{
    float t = size > 1.0f ? texel / (size - 1.0f) : 0.0f;
    return t * t * last;
}

SHARED_FUNCTION float lut_coordinate(float value, float size, float last)
{
    float t = last > 0.0f && value > 0.0f ? sqrt(value < last ? value / last : 1.0f) : 0.0f;
    return (t * (size - 1.0f) + 0.5f) / size;
}

// `size`: width and height of the whole table in texels.
SHARED_FUNCTION vec2 lut_uv(LutAxes axes, uint part, float injury_depth_mm, float day, vec2 size)
{
    float v = lut_coordinate(day, size.y / float(LUT_PARTS), axes.last_day);
    return vec2(lut_coordinate(injury_depth_mm, size.x, axes.deepest_mm), (float(part) + v) / float(LUT_PARTS));
}

#undef CONSTANT

#ifdef __cplusplus
} // namespace shared
#endif
#endif
