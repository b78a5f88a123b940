// A wound's maps of a day on the CPU, for drawing or measuring wounds without a graphics device: warped
// colour, depth and coverage of bed and border, and relief. The reference for shaders/wound_texture.comp and
// shaders/wound_relief.comp; a test compares them.
//
//   const DayMaps maps = maps_on(prepared, wound_at(prepared, healing, 9), drawn_region(prepared, healing));
//   const MapSample here = sample(maps, {.1, -.05});
#pragma once
#include <opencv2/core.hpp>

#include "shaders/shared/wound.h"
#include "wound/wound.hpp"

namespace wound {

/// Day 0's maps as read by shaders and maps_on(). Color: rgb linear reflectance, a opacity. Shape: depth in
/// mm, coverage of the mask.
cv::Mat4f day0_color(const Patch& patch);
cv::Mat2f day0_shape(const Patch& patch);

/// Parameters of today's relief, for texels `texel_mm` wide.
shared::Relief relief_parameters(const WoundDay& today, double texel_mm);

/// Today's maps of a region of the patch that contains everything visible of the wound.
struct DayMaps
{
    cv::Rect region;    // texels of the patch
    int patch_size = 0; // texels a side
    cv::Mat4f color;    // rgb: linear reflectance W; a: opacity, 0 on the face's own skin
    cv::Mat4f state;    // channels 0, 1: day 0's depth in mm, warped with the open bed and with the border;
                        // 2: coverage of the open bed; 3: coverage inside the border
    cv::Mat4f relief; // channels 0, 1: slope of the depth and of the bed's bumps along u and v, mm per mm; 2:
                      // ambient occlusion, 1 is open; 3: today's depth in mm

    /// Texture coordinates in the maps: 0..1 within the region.
    cv::Point2d uv(cv::Point2d patch_point) const;
};

/// `today` is a day of this wound. `region`: drawn_region(), or the whole patch. Uses all cores.
DayMaps maps_on(const PreparedWound& wound, const WoundDay& today, cv::Rect region);

struct MapSample
{
    cv::Vec4d color{0, 0, 0, 0}, state{0, 0, 0, 0}, relief{0, 0, 1, 0};
    double slope_variance = 0; // within the footprint: 2 x the variance of the slope along each axis
};

/// The maps at a point of the patch; the default sample outside the region. `footprint`: a quarter of a
/// pixel's extent in patch coordinates, by which the rasteriser blurs; 0 for a ray.
MapSample sample(const DayMaps& maps, cv::Point2d patch_point, cv::Point2d footprint = {});

} // namespace wound
