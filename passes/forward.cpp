#include "passes/forward.hpp"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "passes/diffusion.hpp"
#include "passes/part_bindings.hpp"
#include "passes/shading.hpp"

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
            .sheen = float(today.scar.sheen),
            .number = wound.index + 1};
}

/// The pixels in which a wound's images can show, or light that has spread from there; all of them when the
/// camera is inside the wound's reach.
graph::Region pixels_of(const ForwardWound& wound, double reach_m, const shared::View& view,
                        std::uint32_t width, std::uint32_t height)
{
    constexpr double margin = 2; // pixels, for rounding
    const head::Anchor& anchor = wound.anchor;
    const glm::dvec2 scale(wound.texture.uv_scale), offset(wound.texture.uv_offset);
    glm::dvec2 low(width, height), high(0, 0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec2 side(corner & 1, corner >> 1 & 1);
        const double reach = reach_m / anchor.half_width_m;
        const glm::dvec2 at =
            (side - offset) / scale + (2. * side - 1.) * reach; // on the patch, -1..1 all of it
        const double height_of = ((corner & 4) != 0 ? 1 : -1) * (head::Anchor::reach + reach);
        const glm::dvec3 point =
            anchor.centre +
            anchor.half_width_m * (at.x * anchor.right + at.y * anchor.down + height_of * anchor.normal);
        const glm::dvec4 clip = glm::dmat4(view.clip_from_world) * glm::dvec4(point, 1);
        if (!(clip.w > 1e-3))
            return {0, 0, width, height};
        const glm::dvec2 pixel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(width, height);
        low = glm::min(low, pixel - margin);
        high = glm::max(high, pixel + margin);
    }
    const glm::dvec2 all(width, height);
    const glm::uvec2 first(glm::clamp(low, glm::dvec2(0), all)),
        last(glm::ceil(glm::clamp(high, glm::dvec2(0), all)));
    return {first.x, first.y, last.x - first.x, last.y - first.y};
}

/// Declares that a new day changes the picture only where the wounds are. `shown`: HeadPart::wounds of all
/// that is drawn; the images of a wound that reaches no triangle are not sampled. Returns where that is.
graph::Region confine_wounds(graph::RasterPass& pass, std::span<const ForwardWound> wounds,
                             const std::set<std::uint32_t>& shown, const shared::View& view,
                             const graph::ImageDesc& target)
{
    graph::Region all;
    for (const ForwardWound& wound : wounds) {
        if (!shown.contains(wound.index))
            continue;
        const graph::Region region = pixels_of(wound, 0, view, target.width, target.height);
        all = bounds(all, region);
        for (const graph::ImageId image : {wound.texture.color, wound.texture.state, wound.texture.relief})
            pass.confine(image, region);
    }
    if (!all.empty())
        pass.confine("Wounds_", all);
    return all;
}

/// The same of images on the skin's atlas. `wounds`: all of the head's. `source`: what a new day can change
/// of the images.
void confine_skin(graph::RasterPass& pass, std::initializer_list<graph::ImageId> images,
                  const graph::Region& source, double reach_m, std::span<const ForwardWound> wounds,
                  const shared::View& view, const graph::ImageDesc& target)
{
    graph::Region all;
    for (const ForwardWound& wound : wounds)
        all = bounds(all, pixels_of(wound, reach_m, view, target.width, target.height));
    for (const graph::ImageId image : images)
        pass.confine(image, source, all);
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
    assert(wounds.size() <= shared::WOUNDS_HERE);
    WoundUniform uniform{};
    for (std::size_t i = 0; i < wounds.size(); ++i)
        uniform.frames[i] = wound_frame(wounds[i]);
    return uniform;
}

namespace {

/// What draw_parts() binds once.
void prepare_parts(graph::Graph& graph, graph::RasterPass& pass, const ForwardInput& input,
                   const optics::Shading& shading)
{
    pass.constant("LAMBERT", shading.lambertian());
    pass.constant("TRANSPORT", std::uint32_t(shading.pointwise_transport()));
    pass.constant("NORMAL_MAP", shading.normal_map);
    pass.constant("BOUNCE", shading.bounce);
    pass.constant("TRANSLUCENCY_MODEL", std::uint32_t(shading.translucency_model));
    pass.constant("BLEND_MODEL", std::uint32_t(shading.blend_model));
    pass.uniform("Shadows_", input.shadows.lights);
    pass.sample("shadow_map",
                input.shadows.casting != 0 ? input.shadow_depth : graph.import("white", *input.head.white),
                graph::Sampler::NearestClamp);
}

const HeadPart& part_of(const ForwardInput& input, std::uint32_t material)
{
    return *std::ranges::find(input.head.parts, material, &HeadPart::material);
}

void bind_lit(graph::Graph& graph, graph::Draw& draw, const ForwardInput& input, const HeadPart& part,
              const WoundSet& wounds, const optics::Shading& shading)
{
    const shared::Part params = part_params(part, shading);
    draw.uniform("Part_", params);
    draw.constant("WARD", shading.glossy() && params.specular > 0);
    bind_part(graph, draw, input.head, part, wounds, input.wounds);
}

/// Parts of the mesh whose light is computed in every pixel.
void draw_parts(graph::Graph& graph, graph::RasterPass& pass, const ForwardInput& input,
                std::span<const HeadPart> parts, const optics::Shading& shading)
{
    for (const HeadPart& part : parts) {
        graph::Draw& draw = pass.draw(input.apart ? "apart" : "forward");
        if (input.apart)
            draw.constant("SPREADS", part.surface == head::Surface::Skin && !part.blend);
        draw.mesh = input.head.mesh.get();
        draw.first_index = part.first_index;
        draw.index_count = part.index_count;
        draw.cull_back_faces = !part.double_sided;
        draw.blend = part.blend;
        draw.depth_write = !part.blend;
        bind_lit(graph, draw, input, part, part.wounds, shading);
    }
}

/// Skin whose light is computed in every pixel, but for what comes from the surroundings with transport
/// `diffused`.
void draw_lit_skin(graph::Graph& graph, graph::RasterPass& pass, const ForwardInput& input,
                   std::span<const SkinDraw> pieces, const optics::Shading& shading)
{
    for (const SkinDraw& piece : pieces) {
        graph::Draw& draw = pass.draw(input.around ? "diffused" : "forward");
        draw.mesh = input.skin->mesh.get();
        draw.first_index = piece.first_index;
        draw.index_count = piece.index_count;
        bind_lit(graph, draw, input, part_of(input, piece.material), piece.wounds, shading);
        if (input.around) {
            draw.constant("TRANSPORT", std::uint32_t(optics::Transport::Diffused));
            draw.sample("diffused_light", input.around->light);
        }
    }
}

/// The skin, with the light that is kept on it.
void draw_skin(graph::RasterPass& pass, const ForwardInput& input, const SkinLight& kept,
               const optics::Shading& shading)
{
    for (const SkinShown& shown : input.skin->shown) {
        graph::Draw& draw = pass.draw("skin");
        draw.mesh = input.skin->mesh.get();
        draw.first_index = shown.first_index;
        draw.index_count = shown.index_count;
        const shared::Part params = part_params(part_of(input, shown.material), shading);
        draw.uniform("Part_", params);
        draw.uniform("Code_", kept.code);
        draw.constant("WARD", shading.glossy() && params.specular > 0);
        draw.constant("WOUNDED", shown.wounded);
        draw.sample("light_map", kept.light);
        draw.sample("lit_normal", kept.normal);
        draw.sample("skin_gloss", kept.gloss);
    }
}

/// Adds a colour target, resolved when there are several samples.
graph::ImageId add_target(graph::Graph& graph, graph::RasterPass& pass, const std::string& name,
                          const graph::ImageDesc& desc, const std::array<float, 4>& clear)
{
    const graph::ImageId image = graph.image(name, {desc.width, desc.height, desc.format});
    if (desc.samples > 1)
        pass.color(graph.image(name + "_msaa", desc), clear, image);
    else
        pass.color(image, clear);
    return image;
}

LightApart add_targets_apart(graph::Graph& graph, graph::RasterPass& pass, graph::ImageDesc desc)
{
    desc.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    LightApart apart{.received = add_target(graph, pass, "received light", desc, {0, 0, 0, 1}),
                     .reflectance = add_target(graph, pass, "reflectance", desc, {0, 0, 0, 0})};
    desc.format = VK_FORMAT_R32_SFLOAT;
    apart.distance = add_target(graph, pass, "distance", desc, {0, 0, 0, 0});
    return apart;
}

} // namespace

ForwardImages add_forward(graph::Graph& graph, const ForwardInput& input, const shared::View& view,
                          const optics::Shading& shading, const graph::ImageDesc& target)
{
    const VkFormat format = input.developed ? VK_FORMAT_R8G8B8A8_UNORM : VK_FORMAT_R16G16B16A16_SFLOAT;
    graph::RasterPass& pass = graph.raster("forward");
    ForwardImages drawn{.radiance =
                            add_target(graph, pass,
                                       input.developed ? "encoded"
                                       : input.apart   ? "specular light"
                                                       : "radiance",
                                       {target.width, target.height, format, target.samples}, {0, 0, 0, 0})};
    if (input.apart)
        drawn.apart = add_targets_apart(graph, pass, target);
    pass.depth(graph.image("depth", {target.width, target.height, VK_FORMAT_D32_SFLOAT, target.samples}));
    if (input.every_frame)
        pass.every_frame();

    pass.constant("LIGHTS", std::uint32_t(input.lights.size()));
    pass.constant("SHADOWS", input.shadows.casting);
    pass.constant("AMBIENT", shading.ambient != base::Color(0, 0, 0));
    pass.constant("WARD_MODEL", std::uint32_t(shading.ward_model));
    pass.constant("SPECULAR_MODEL", std::uint32_t(shading.specular_model));
    pass.constant("DEVELOPED", input.developed.has_value());
    pass.uniform("View_", view);
    pass.uniform("Shading_", shading_params(shading, input.scattering_length_mm));
    pass.uniform("Lighting_", lighting(input.lights));
    pass.uniform("Develop_", input.developed.value_or(shared::Develop{}));
    std::vector<HeadPart> parts = input.head.parts;
    std::vector<SkinDraw> lit; // skin whose light is computed in every pixel, with its place on the atlas
    if (input.kept || input.around) {
        std::erase_if(parts, [&](const HeadPart& part) {
            return std::ranges::find(input.skin->materials, part.material) != input.skin->materials.end();
        });
        lit = input.kept ? input.skin->rest : input.skin->lit;
        if (input.kept)
            draw_skin(pass, input, *input.kept, shading);
    }
    draw_lit_skin(graph, pass, input, lit, shading);
    draw_parts(graph, pass, input, parts, shading);
    if (!parts.empty() || !lit.empty())
        prepare_parts(graph, pass, input, shading);
    if (input.developed) {
        graph::Draw& backdrop = pass.draw("backdrop");
        backdrop.index_count = 6 * shared::BACKDROP_BANDS;
    }
    std::set<std::uint32_t> shown;
    for (const HeadPart& part : parts)
        shown.insert(part.wounds.begin(), part.wounds.end());
    for (const SkinDraw& piece : lit)
        shown.insert(piece.wounds.begin(), piece.wounds.end());
    const graph::Region wounded = confine_wounds(pass, input.wounds, shown, view, target);
    if (drawn.apart)
        drawn.apart->wounded = wounded;
    if (const SkinLight* kept = input.kept)
        confine_skin(pass, {kept->light, kept->normal, kept->gloss}, kept->wounded, kept->reach_m,
                     input.placed, view, target);
    if (!lit.empty() && input.around)
        confine_skin(pass, {input.around->light}, input.around->wounded, input.around->reach_m, input.placed,
                     view, target);
    return drawn;
}

} // namespace passes
