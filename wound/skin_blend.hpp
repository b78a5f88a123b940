// Applies a wound to a point of skin: the colour C of eq. (4) of Choi & Chin 2014 and the other inputs of
// shading. The double-precision reference for add_wound() in shaders/lib/wound_projection.glsl and its use in
// shaders/forward.frag; a test compares them.
//
//   const glm::dvec3 p = head::in_frame(anchor, position);
//   const double facing = head::share_received(dot(normal, anchor.normal), p.z);
//   const SkinPoint seen = with_wound({own_albedo, mapped_normal}, wound, {{p.x, p.y}, facing, ...}, model);
#pragma once
#include <opencv2/core.hpp>

#include "base/color.hpp"
#include "shaders/shared/reflectance_lut.h"
#include "wound/day_maps.hpp"
#include "wound/optics/shading.hpp"
#include "wound/wound.hpp"

namespace wound {

/// A point of skin as input of shading.
struct SkinPoint
{
    base::Color albedo;   // C of eq. (4)
    cv::Vec3d normal;     // unit
    double occlusion = 1; // of the wounds' hollows: 1 open
    double wetness = 0;   // 0 dry skin .. 1 open bed
    double tautness = 0;  // 0 porous skin .. 1 new epithelium
    double slope_variance = 0; // of optics::Finish
};

/// A wound on a day with its maps and reflectance table. The caller owns the data.
struct WoundLook
{
    const WoundDay& today;
    const DayMaps& maps;
    const cv::Mat3f& reflectance; // bake_reflectance_table()
    shared::LutAxes axes;         // of the table
};

/// The position of a point of skin in a wound's patch. Vectors are in the space of the point's normal.
struct PatchPlace
{
    cv::Point2d at;                 // patch coordinates
    double facing = 1;              // factor 0..1 on the wound's opacity, by the skin's orientation
    cv::Vec3d right, down;          // the patch's axes, unit
    cv::Vec3d geometric;            // interpolated normal, unit, without the normal map
    cv::Point2d footprint = {0, 0}; // see sample()
};

/// `skin`: the face's own skin, or the result for the wounds added so far.
SkinPoint with_wound(SkinPoint skin, const WoundLook& wound, const PatchPlace& place,
                     optics::BlendModel model);

/// The specular parameters for this tautness: taut new epithelium has a slightly narrower lobe. The film on a
/// wet bed is finish_of()'s; SpecularModel::Ward knows none, and there a wet bed has a narrower, dimmer lobe.
/// Eq. (7) alone (optics::only_ward()) gets the shading as it is; nor does the point's occlusion dim it.
optics::Shading with_gloss(optics::Shading shading, const SkinPoint& skin);
optics::Finish finish_of(const SkinPoint& skin);

} // namespace wound
