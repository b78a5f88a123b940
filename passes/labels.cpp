#include "passes/labels.hpp"

#include <algorithm>
#include <cmath>

#include "passes/part_bindings.hpp"

namespace passes {

LabelImages add_labels(graph::Graph& graph, const Head& head, std::span<const ForwardWound> wounds,
                       const shared::View& view, const shared::LabelCamera& camera,
                       std::array<std::uint32_t, 2> size)
{
    const auto [width, height] = size;
    const LabelImages images{graph.image("label_kinds", {width, height, VK_FORMAT_R8G8_UNORM}),
                             graph.image("label_measures", {width, height, VK_FORMAT_R32G32B32A32_SFLOAT})};
    graph::RasterPass& pass = graph.raster("labels");
    pass.color(images.kinds, {0, 0, 0, 0});
    pass.color(images.measures, {0, 0, 0, 0});
    pass.depth(graph.image("label_depth", {width, height, VK_FORMAT_D32_SFLOAT}));
    pass.uniform("View_", view);
    pass.uniform("LabelCamera_", camera);

    const graph::ImageId blank = graph.import("label blank", *head.white);
    for (const HeadPart& part : head.parts) {
        if (part.blend)
            continue;
        // Every sampler of the shader must be bound; unused ones get the white texel.
        std::vector<graph::ImageId> state(shared::WOUNDS_HERE, blank), relief = state;
        const std::vector<ForwardWound> showing = of_set(part.wounds, wounds);
        for (std::size_t i = 0; i < showing.size(); ++i) {
            state[i] = showing[i].texture.state;
            relief[i] = showing[i].texture.relief;
        }
        graph::Draw& draw = pass.draw("labels");
        draw.mesh = head.mesh.get();
        draw.first_index = part.first_index;
        draw.index_count = part.index_count;
        draw.cull_back_faces = !part.double_sided;
        draw.constant("WOUNDS", std::uint32_t(showing.size()));
        draw.uniform("Wounds_", wound_frames(showing));
        draw.constant("SURFACE",
                      part.surface == head::Surface::Skin ? shared::LABEL_SKIN : shared::LABEL_OTHER);
        draw.sample("wound_state", state);
        draw.sample("wound_relief", relief);
    }
    return images;
}

shared::LabelCamera label_camera(const head::Camera& camera, const ViewportTile& tile)
{
    const double pixel = 2 * std::tan(glm::radians(camera.fov_deg) / 2) / tile.picture[1]; // 1 / fy = 1 / fx
    return {glm::vec3(camera.eye), glm::vec3(glm::normalize(camera.target - camera.eye)),
            float(pixel * pixel)};
}

LabelMaps label_maps(const cv::Mat2b& kinds, const cv::Mat4f& measures)
{
    LabelMaps maps;
    cv::extractChannel(kinds, maps.kinds, 0);
    cv::extractChannel(kinds, maps.wounds, 1);
    maps.wounds.setTo(0,
                      (maps.kinds != shared::LABEL_OPEN_BED) & (maps.kinds != shared::LABEL_NEW_EPITHELIUM));
    cv::extractChannel(measures, maps.depth_mm, 0);
    cv::extractChannel(measures, maps.distance_mm, 1);
    return maps;
}

std::vector<VisibleWound> visible_wounds(const cv::Mat2b& kinds, const cv::Mat4f& measures, std::size_t count)
{
    struct Box
    {
        int left = INT_MAX, top = INT_MAX, right = -1, bottom = -1;
    };
    std::vector<VisibleWound> seen(count);
    std::vector<Box> boxes(count);
    for (int y = 0; y < kinds.rows; ++y)
        for (int x = 0; x < kinds.cols; ++x) {
            const auto [kind, number] = kinds(y, x).val;
            if (number == 0 || number > count)
                continue;
            VisibleWound& wound = seen[number - 1u];
            wound.bed_mm2 += measures(y, x)[2];
            wound.inside_mm2 += measures(y, x)[3];
            const bool bed = kind == shared::LABEL_OPEN_BED, ring = kind == shared::LABEL_NEW_EPITHELIUM;
            wound.bed_px += bed;
            wound.epithelium_px += ring;
            if (!bed && !ring)
                continue;
            Box& box = boxes[number - 1u];
            box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x),
                   std::max(box.bottom, y)};
        }
    for (std::size_t i = 0; i < count; ++i)
        if (boxes[i].right >= 0)
            seen[i].box = cv::Rect(cv::Point(boxes[i].left, boxes[i].top),
                                   cv::Point(boxes[i].right + 1, boxes[i].bottom + 1));
    return seen;
}

WoundSize wound_size(const cv::Mat1f& surface_mm2, const cv::Mat4f& state, const cv::Mat4f& relief)
{
    CV_Assert(surface_mm2.size() == state.size() && surface_mm2.size() == relief.size());
    WoundSize size;
    for (int y = 0; y < state.rows; ++y)
        for (int x = 0; x < state.cols; ++x) {
            const double area = surface_mm2(y, x), bed = state(y, x)[2],
                         inside = std::max(state(y, x)[2], state(y, x)[3]), depth = relief(y, x)[3];
            if (!(area > 0) || !(inside > 0))
                continue;
            size.bed_mm2 += area * bed;
            size.inside_mm2 += area * inside;
            size.volume_mm3 += area * inside * std::max(depth, 0.0);
            if (inside >= 0.5)
                size.deepest_mm = std::max(size.deepest_mm, depth);
        }
    return size;
}

} // namespace passes
