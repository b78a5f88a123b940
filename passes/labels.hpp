// Labels of a picture, pixel by pixel, for people who train or test programs that measure wounds: what is
// seen there, which wound, how deep, how far away, and how much real surface. Unblended and with one sample
// per pixel, at the same pixel centres as the picture; what is blended over the head (brows, lashes) hides
// nothing.
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
    graph::ImageId kinds; // RG8: shared::LABEL_..., number of the wound from 1 (0: none)
    graph::ImageId
        measures; // RGBA32F: depth of the hollow in mm (negative: a raised scar), 0 outside wounds;
                  // distance along the optical axis in mm, 0 beside the head;
                  // the wound's surface in the pixel in mm2: of the open bed; inside the outer border
};

/// Adds one raster pass "labels", which the graph drops when nobody reads it.
LabelImages add_labels(graph::Graph& graph, const Head& head, std::span<const ForwardWound> wounds,
                       const shared::View& view, const shared::LabelCamera& camera,
                       std::array<std::uint32_t, 2> size);

/// What the pass must know of the camera beside its view: how much a pixel holds.
shared::LabelCamera label_camera(const head::Camera& camera, const ViewportTile& tile);

/// The labels of one frame on the CPU.
struct LabelMaps
{
    cv::Mat1b kinds;    // shared::LABEL_...
    cv::Mat1b wounds;   // number of the wound from 1 where its bed or new epithelium is seen, else 0
    cv::Mat1f depth_mm; // as in LabelImages
    cv::Mat1f distance_mm;
};
LabelMaps label_maps(const cv::Mat2b& kinds, const cv::Mat4f& measures);

/// What is seen of one wound in one frame.
struct VisibleWound
{
    std::int64_t bed_px = 0, epithelium_px = 0;
    double bed_mm2 = 0, inside_mm2 = 0; // real surface that is seen: of the open bed, inside the outer border
    cv::Rect box;                       // of bed and new epithelium; empty when nothing is seen
};
/// One for each of `count` wounds.
std::vector<VisibleWound> visible_wounds(const cv::Mat2b& kinds, const cv::Mat4f& measures,
                                         std::size_t count);

/// What a wound measures on the head itself, seen or not.
struct WoundSize
{
    double bed_mm2 = 0, inside_mm2 = 0; // on the curved surface: of the open bed, inside the outer border
    double deepest_mm = 0;              // 0 when nothing is hollow
    double volume_mm3 = 0;              // of the hollow
};
/// `surface_mm2`: surface_under() at the size of today's maps `state` and `relief`
/// (passes/wound_texture.hpp).
WoundSize wound_size(const cv::Mat1f& surface_mm2, const cv::Mat4f& state, const cv::Mat4f& relief);

} // namespace passes
