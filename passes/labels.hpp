// Per-pixel labels of a picture, to train or test programs that measure wounds: kind of surface, wound,
// depth, distance and surface area. Drawn unblended, with one sample at the centre of each pixel of the
// picture; blended parts of the head (brows, lashes) are ignored.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "engine/graph/graph.hpp"
#include "passes/forward.hpp"
#include "shaders/shared/labels.h"

namespace passes {

struct LabelImages
{
    graph::ImageId kinds; // RG8: shared::LABEL_...; number of the wound from 1 (0: none)
    graph::ImageId
        measures; // RGBA32F: depth of the wound in mm (negative: a raised scar), 0 outside wounds;
                  // distance along the optical axis in mm, 0 beside the head;
                  // the wound's surface area in the pixel in mm2: open bed; inside the outer border
};

/// Adds one raster pass "labels", which the graph drops when nothing reads its images.
LabelImages add_labels(graph::Graph& graph, const Head& head, std::span<const ForwardWound> wounds,
                       const shared::View& view, const shared::LabelCamera& camera,
                       std::array<std::uint32_t, 2> size);

/// The camera's parameters that the pass needs in addition to its view.
shared::LabelCamera label_camera(const head::Camera& camera, const ViewportTile& tile);

/// The labels of one frame, on the CPU.
struct LabelMaps
{
    cv::Mat1b kinds;    // shared::LABEL_...
    cv::Mat1b wounds;   // number of the wound from 1 where its bed or new epithelium is visible, else 0
    cv::Mat1f depth_mm; // as in LabelImages
    cv::Mat1f distance_mm;
};
LabelMaps label_maps(const cv::Mat2b& kinds, const cv::Mat4f& measures);

/// The visible part of one wound in one frame.
struct VisibleWound
{
    std::int64_t bed_px = 0, epithelium_px = 0;
    double bed_mm2 = 0, inside_mm2 = 0; // visible surface area: of the open bed, inside the outer border
    cv::Rect box;                       // of bed and new epithelium, px; empty when nothing is visible
};
/// One entry for each of `count` wounds.
std::vector<VisibleWound> visible_wounds(const cv::Mat2b& kinds, const cv::Mat4f& measures,
                                         std::size_t count);

/// The size of a wound on the head, visible or not.
struct WoundSize
{
    double bed_mm2 = 0, inside_mm2 = 0; // on the curved surface: of the open bed, inside the outer border
    double deepest_mm = 0;              // largest depth; 0 without any depression
    double volume_mm3 = 0;              // of the depression
};
/// `surface_mm2`: from head::surface_under(), of the same size as today's maps `state` and `relief`
/// (passes/wound_texture.hpp).
WoundSize wound_size(const cv::Mat1f& surface_mm2, const cv::Mat4f& state, const cv::Mat4f& relief);

} // namespace passes
