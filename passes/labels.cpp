#include "passes/labels.hpp"

#include <algorithm>
#include <cmath>

namespace passes {

LabelImages add_labels(engine::Graph& graph, const Head& head, std::span<const PlacedWound> wounds,
                       const shared::View& view, const shared::LabelCamera& camera, std::uint32_t width,
                       std::uint32_t height)
{
    const LabelImages images{graph.image("label_kinds", {width, height, VK_FORMAT_R8G8_UNORM}),
                             graph.image("label_measures", {width, height, VK_FORMAT_R32G32B32A32_SFLOAT})};
    engine::RasterPass& pass = graph.raster("labels");
    pass.color(images.kinds, {0, 0, 0, 0});
    pass.color(images.measures, {0, 0, 0, 0});
    pass.depth(graph.image("label_depth", {width, height, VK_FORMAT_D32_SFLOAT}));
    pass.uniform("View_", view);
    pass.uniform("LabelCamera_", camera);
    pass.uniform("Wounds_", wound_frames(wounds));

    const engine::ImageId blank = graph.import("label blank", *head.white);
    for (const HeadPart& part : head.parts) {
        if (part.blend)
            continue;
        // Every sampler of the shader must be given; a draw without wounds gets the white texel instead.
        std::vector<engine::ImageId> state(shared::MAX_WOUNDS, blank), relief = state;
        for (std::size_t i = 0; part.wounded && i < wounds.size(); ++i) {
            state[i] = wounds[i].texture.state;
            relief[i] = wounds[i].texture.relief;
        }
        engine::Draw& draw = pass.draw("labels");
        draw.mesh = head.mesh.get();
        draw.first_index = part.first_index;
        draw.index_count = part.index_count;
        draw.cull_back_faces = !part.double_sided;
        draw.constant("WOUNDS", part.wounded ? std::uint32_t(wounds.size()) : 0u);
        draw.constant("SURFACE", part.surface == Surface::Skin ? shared::LABEL_SKIN : shared::LABEL_OTHER);
        draw.sample("wound_state", state);
        draw.sample("wound_relief", relief);
    }
    return images;
}

Pinhole pinhole(const Camera& camera, std::uint32_t width, std::uint32_t height)
{
    const glm::dmat3 flip(1, 0, 0, 0, -1, 0, 0, 0, -1); // OpenGL's camera looks along -z with y up
    const glm::dmat4 eye = eye_from_world(camera);
    Pinhole result;
    result.focal_px = 0.5 * height / std::tan(glm::radians(camera.fov_deg) / 2);
    result.cx = 0.5 * width - 0.5;
    result.cy = 0.5 * height - 0.5;
    result.rotation = flip * glm::dmat3(eye);
    result.translation_mm = 1e3 * (flip * glm::dvec3(eye[3]));
    return result;
}

glm::dvec3 project(const Pinhole& camera, const glm::dvec3& point_m)
{
    const glm::dvec3 seen = camera.rotation * (1e3 * point_m) + camera.translation_mm;
    return {camera.focal_px * seen.x / seen.z + camera.cx, camera.focal_px * seen.y / seen.z + camera.cy,
            seen.z};
}

shared::LabelCamera label_camera(const Camera& camera, const Pinhole& pinhole)
{
    return {glm::vec3(camera.eye), glm::vec3(glm::transpose(pinhole.rotation)[2]),
            float(1 / (pinhole.focal_px * pinhole.focal_px))};
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
