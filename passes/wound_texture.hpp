// Warps a wound's day-0 maps to today and derives its slope and occlusion for shading. Two compute passes per
// wound, both skipped while the wound and the day are unchanged.
#pragma once
#include <memory>
#include <string>

#include "engine/gpu/device.hpp"
#include "engine/gpu/texture.hpp"
#include "engine/graph/graph.hpp"
#include "shaders/shared/warp.h"
#include "wound/wound.hpp"

namespace passes {

/// A wound's day-0 maps on the device, uploaded once.
struct WoundMaps
{
    std::shared_ptr<const gpu::Texture> color; // rgb linear reflectance, a opacity
    std::shared_ptr<const gpu::Texture> shape; // r depth in mm, g coverage of the mask
    double bed_luminance = 0;                  // median of the open bed
    double width_mm = 0;                       // of the patch
    int size = 0;                              // texels a side
    cv::Rect region;                           // texels of the patch that today's maps cover; default: all
};
WoundMaps upload_wound(const gpu::Device& device, const wound::Patch& patch);

/// Today's maps of the patch's region, RGBA16F; shaders sample them by project_wound()
/// (shaders/lib/wound_projection.glsl).
struct WoundTexture
{
    graph::ImageId color;  // rgb: linear reflectance W; a: opacity, 0 shows the face's skin
    graph::ImageId state;  // depth on day 0 in mm, r: of the open bed, g: of the injury inside the
                           // outer border; b: coverage of the open bed; a: coverage inside the border
    graph::ImageId relief; // rg: slope of depth and bumps along u and v, mm per mm; b: ambient occlusion, 1
                           // open; a: depth today in mm
    shared::vec2 uv_scale{.5}, uv_offset{.5}; // uv of the images = scale * patch coordinates + offset
};

/// The day's warps as the shader reads them: large, so pack them once a day.
struct PackedWarps
{
    shared::WarpHeader border, bed;
    graph::Bytes values;
};
PackedWarps pack_warps(const wound::WoundDay& today);

/// `warps`: pack_warps(today). The images have the size of maps.region, which must be the same on all days.
/// `suffix` makes the names of passes and images unique among the wounds of a scene: "" for the first, " 2"
/// for the second.
WoundTexture add_wound_texture(graph::Graph& graph, const std::string& suffix, const WoundMaps& maps,
                               const wound::WoundDay& today, const PackedWarps& warps);

} // namespace passes
