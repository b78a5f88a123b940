#include "passes/forward.hpp"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "passes/shading.hpp"
#include "shaders/shared/part.h"
#include "wound/optics/specular.hpp"

namespace passes {
namespace {

shared::vec3 to_vec3(const glm::dvec3& v)
{
    return shared::vec3(v);
}

shared::WoundFrame wound_frame(const ForwardWound& wound)
{
    const head::Anchor& anchor = wound.anchor;
    const wound::WoundDay& today = *wound.today;
    return {.centre = to_vec3(anchor.centre),
            .half_width = float(anchor.half_width_m),
            .right = to_vec3(anchor.right),
            .reach = float(head::Anchor::reach),
            .down = to_vec3(anchor.down),
            .day = float(today.day),
            .normal = to_vec3(anchor.normal),
            .uv_scale = wound.texture.uv_scale,
            .uv_offset = wound.texture.uv_offset,
            .bed_recovery = float(today.bed_recovery),
            .border_recovery = float(today.border_recovery),
            .lut = wound.axes,
            .epithelium = float(today.border_softness),
            .pore_loss = float(today.scar.pore_loss),
            .sheen = float(today.scar.sheen)};
}

shared::Part part_params(const HeadPart& part, optics::Shading shading)
{
    const head::Gloss gloss = head::gloss_of(part.surface);
    shading.alpha_x *= gloss.slope;
    shading.alpha_y *= gloss.slope;
    return {.albedo_factor = part.albedo_factor,
            .normal_scale = part.normal_scale,
            .specular = float(gloss.specular),
            .slope = float(gloss.slope),
            .grazing = float(optics::grazing_reflectance(shading)),
            .translucency = part.surface == head::Surface::Eye ? 0.5f : 1.f,
            .scattering = part.surface == head::Surface::Skin ? 1.f : 0.f};
}

/// Binds every wound sampler of the shader; unused ones get the head's white texel.
void bind_wounds(graph::Draw& draw, const ForwardInput& input, bool wounded, graph::ImageId blank)
{
    std::vector<graph::ImageId> color(shared::MAX_WOUNDS, blank), state = color, relief = color, lut = color;
    for (std::size_t i = 0; wounded && i < input.wounds.size(); ++i) {
        color[i] = input.wounds[i].texture.color;
        state[i] = input.wounds[i].texture.state;
        relief[i] = input.wounds[i].texture.relief;
        lut[i] = input.wounds[i].lut.reflectance;
    }
    draw.constant("WOUNDS", wounded ? std::uint32_t(input.wounds.size()) : 0u);
    draw.sample("wound_color", color);
    draw.sample("wound_state", state);
    draw.sample("wound_relief", relief);
    draw.sample("reflectance_lut", lut);
}

/// The pixels in which a wound's images can show; all of them when the camera is inside the wound's reach.
graph::Region pixels_of(const ForwardWound& wound, const shared::View& view, std::uint32_t width, std::uint32_t height)
{
    constexpr double margin = 2; // pixels, for rounding
    const head::Anchor& anchor = wound.anchor;
    const glm::dvec2 scale(wound.texture.uv_scale), offset(wound.texture.uv_offset);
    glm::dvec2 low(width, height), high(0, 0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec2 at = (glm::dvec2(corner & 1, corner >> 1 & 1) - offset) / scale; // on the patch, -1..1 all of it
        const double height_of = (corner & 4) != 0 ? head::Anchor::reach : -head::Anchor::reach;
        const glm::dvec3 point =
            anchor.centre + anchor.half_width_m * (at.x * anchor.right + at.y * anchor.down + height_of * anchor.normal);
        const glm::dvec4 clip = glm::dmat4(view.clip_from_world) * glm::dvec4(point, 1);
        if (!(clip.w > 1e-3))
            return {0, 0, width, height};
        const glm::dvec2 pixel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(width, height);
        low = glm::min(low, pixel - margin);
        high = glm::max(high, pixel + margin);
    }
    const glm::dvec2 all(width, height);
    const glm::uvec2 first(glm::clamp(low, glm::dvec2(0), all)), last(glm::ceil(glm::clamp(high, glm::dvec2(0), all)));
    return {first.x, first.y, last.x - first.x, last.y - first.y};
}

/// Declares that a new day changes the picture only where the wounds are.
void confine_wounds(graph::RasterPass& pass, std::span<const ForwardWound> wounds, const shared::View& view,
                    const graph::ImageDesc& target)
{
    graph::Region all;
    for (const ForwardWound& wound : wounds) {
        const graph::Region region = pixels_of(wound, view, target.width, target.height);
        all = bounds(all, region);
        for (const graph::ImageId image : {wound.texture.color, wound.texture.state, wound.texture.relief})
            pass.confine(image, region);
    }
    if (!wounds.empty())
        pass.confine("Wounds_", all);
}

} // namespace

shared::View make_view(const head::Camera& camera, const Head& head, const ViewportTile& tile)
{
    const glm::dvec3 low(head.min), high(head.max);
    const double radius = 0.5 * glm::distance(low, high);
    const double distance = glm::distance(camera.eye, 0.5 * (low + high));
    const double near = std::max(distance - radius, 0.02), far = distance + radius + 0.1;
    glm::dmat4 projection = glm::perspective(glm::radians(camera.fov_deg), tile.aspect(), near, far);
    projection[1][1] *= -1; // Vulkan's y points down
    return {shared::mat4(tile_from_picture(tile) * projection * head::view_from_world(camera)),
            to_vec3(camera.eye)};
}

WoundUniform wound_frames(std::span<const ForwardWound> wounds)
{
    WoundUniform uniform{};
    for (std::size_t i = 0; i < wounds.size(); ++i)
        uniform.frames[i] = wound_frame(wounds[i]);
    return uniform;
}

graph::ImageId add_forward(graph::Graph& graph, const ForwardInput& input, const shared::View& view,
                           const optics::Shading& shading, const graph::ImageDesc& target)
{
    assert(input.wounds.size() <= shared::MAX_WOUNDS);
    const graph::ImageDesc single{target.width, target.height, VK_FORMAT_R16G16B16A16_SFLOAT, 1};
    const graph::ImageId radiance = graph.image("radiance", single);
    graph::RasterPass& pass = graph.raster("forward");
    if (target.samples > 1)
        pass.color(graph.image("radiance_msaa", {target.width, target.height, single.format, target.samples}),
                   {0, 0, 0, 0}, radiance);
    else
        pass.color(radiance, {0, 0, 0, 0});
    pass.depth(graph.image("depth", {target.width, target.height, VK_FORMAT_D32_SFLOAT, target.samples}));
    if (input.every_frame)
        pass.every_frame();

    pass.constant("LIGHTS", std::uint32_t(input.lights.size()));
    pass.constant("LAMBERT", shading.lambertian());
    pass.constant("TRANSPORT", std::uint32_t(shading.drawn_transport()));
    pass.constant("NORMAL_MAP", shading.normal_map);
    pass.constant("SHADOWS", input.shadows.casting);
    pass.constant("AMBIENT", shading.ambient != base::Color(0, 0, 0));
    pass.constant("WARD_MODEL", std::uint32_t(shading.ward_model));
    pass.constant("SPECULAR_MODEL", std::uint32_t(shading.specular_model));
    pass.constant("TRANSLUCENCY_MODEL", std::uint32_t(shading.translucency_model));
    pass.constant("BLEND_MODEL", std::uint32_t(shading.blend_model));
    pass.uniform("View_", view);
    pass.uniform("Shading_", shading_params(shading, input.scattering_length_mm));
    pass.uniform("Lighting_", lighting(input.lights));
    pass.uniform("Wounds_", wound_frames(input.wounds));
    pass.uniform("Shadows_", input.shadows.lights);
    const graph::ImageId blank = graph.import("white", *input.head.white);
    pass.sample("shadow_map", input.shadows.casting != 0 ? input.shadow_depth : blank,
                graph::Sampler::NearestClamp);

    for (std::size_t i = 0; i < input.head.parts.size(); ++i) {
        const HeadPart& part = input.head.parts[i];
        graph::Draw& draw = pass.draw("forward");
        draw.mesh = input.head.mesh.get();
        draw.first_index = part.first_index;
        draw.index_count = part.index_count;
        draw.cull_back_faces = !part.double_sided;
        draw.blend = part.blend;
        draw.depth_write = !part.blend;
        const shared::Part params = part_params(part, shading);
        draw.uniform("Part_", params);
        draw.constant("WARD", shading.glossy() && params.specular > 0);
        draw.sample("albedo_map", graph.import(fmt::format("albedo {}", i), *part.albedo),
                    graph::Sampler::LinearRepeatMips);
        draw.sample("normal_map", graph.import(fmt::format("normal {}", i), *part.normal),
                    graph::Sampler::LinearRepeatMips);
        draw.sample("occlusion_map", graph.import(fmt::format("occlusion {}", i), *part.occlusion),
                    graph::Sampler::LinearRepeatMips);
        draw.constant("OCCLUSION_MAP", part.occlusion != input.head.white);
        bind_wounds(draw, input, part.wounded, blank);
    }
    // The images of a wound that reaches no triangle are not sampled.
    if (std::ranges::any_of(input.head.parts, &HeadPart::wounded))
        confine_wounds(pass, input.wounds, view, target);
    return radiance;
}

} // namespace passes
