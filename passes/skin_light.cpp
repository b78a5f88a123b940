#include "passes/skin_light.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "passes/diffusion.hpp"
#include "passes/part_bindings.hpp"
#include "passes/shading.hpp"

namespace passes {
namespace {

constexpr float skirt_texels = 2;
constexpr double least_even_slope =
    .02; // below it tan^2 of the half vector loses its digits in single precision

shared::AtlasDraw atlas_draw(const SkinDraw& draw, const glm::vec2& size, float scale)
{
    return {.skirt = skirt_texels / size,
            .low = scale * glm::vec2(draw.corner),
            .high = scale * glm::vec2(draw.corner + draw.size)};
}

graph::Draw& spread(graph::RasterPass& pass, const Skin& skin, const SkinDraw& piece, std::string_view shader,
                    const shared::AtlasDraw& where)
{
    graph::Draw& draw = pass.draw(shader);
    draw.mesh = skin.mesh.get();
    draw.first_index = piece.first_index;
    draw.index_count = piece.index_count;
    draw.cull_back_faces = false; // charts may be mirrored
    draw.uniform("Draw_", where);
    return draw;
}

/// About the brightest light that leaves skin somewhere, but not more than a picture can show.
float brightest(const ForwardInput& input, const optics::Shading& shading, float exposure_stops)
{
    constexpr double shown = 3; // the shoulder of the tone curve leaves .02 above it
    double light = std::max({shading.ambient[0], shading.ambient[1], shading.ambient[2]});
    for (const optics::Light& lamp : input.lights) {
        const glm::dvec3 at(lamp.position[0], lamp.position[1], lamp.position[2]);
        const double nearest = std::max(
            glm::distance(at, glm::clamp(at, glm::dvec3(input.head.min), glm::dvec3(input.head.max))), 1e-3);
        const double ratio = lamp.kind == optics::LightKind::Point ? lamp.reference_distance_m / nearest : 1;
        light += std::max({lamp.strength[0], lamp.strength[1], lamp.strength[2]}) * ratio * ratio;
    }
    return float(std::clamp(shading.rho_d * light, 1e-6, shown * std::exp2(-double(exposure_stops))));
}

/// `code`: none: the light is received, not yet spread, and the images are others'.
SkinLight add_light(graph::Graph& graph, const ForwardInput& input, const Skin& skin, double scale,
                    const optics::Shading& shading, const std::optional<shared::LightCode>& code)
{
    const std::string kind = code ? "" : "coarse ";
    const bool spreads = code && input.around;
    const optics::Transport transport = spreads || !code ? shading.transport == optics::Transport::Chang
                                                               ? optics::Transport::Lambert
                                                               : optics::Transport::Diffused
                                                         : shading.pointwise_transport();
    const glm::uvec2 size(glm::dvec2(skin.size) * scale);
    const graph::ImageDesc desc{size.x, size.y, VK_FORMAT_R8G8B8A8_UNORM};
    // Eight bits of reflectance and light would differ by .45 instead of .23 CIEDE2000 from what every pixel
    // computes.
    const graph::ImageDesc fine{size.x, size.y, VK_FORMAT_R16G16B16A16_SFLOAT};
    const graph::ImageId albedo = graph.image(kind + "skin albedo", fine),
                         normal = graph.image(kind + "skin normal", desc);
    SkinLight kept{.light = graph.image(kind + "skin light", fine),
                   .normal = graph.image(kind + "lit skin normal", desc),
                   .gloss = graph.image(kind + "skin gloss", desc),
                   .albedo = albedo,
                   .code = code.value_or(shared::LightCode{1})};
    const glm::uvec2 corner(glm::dvec2(skin.wounded_corner) * scale),
        wounded(glm::ceil(glm::dvec2(skin.wounded_size) * scale));
    kept.wounded = {corner.x, corner.y, wounded.x, wounded.y};

    graph::RasterPass& map = graph.raster(kind + "skin");
    map.color(albedo, {0, 0, 0, 1});
    map.color(normal, {.5f, .5f, 1, 1});
    map.color(kept.gloss, {0, 0, 0, 1});
    map.constant("NORMAL_MAP", shading.normal_map);
    map.constant("AMBIENT", shading.ambient != base::Color(0, 0, 0));
    map.constant("BLEND_MODEL", std::uint32_t(shading.blend_model));
    graph::RasterPass& lit = graph.raster(kind + "skin light");
    lit.color(kept.light, {0, 0, 0, 1});
    lit.color(kept.normal, {.5f, .5f, 1, 1});
    lit.constant("LIGHTS", std::uint32_t(input.lights.size()));
    lit.constant("TRANSPORT", std::uint32_t(transport));
    lit.constant("RECEIVED", !code);
    lit.constant("SHADOWS", input.shadows.casting);
    lit.constant("BOUNCE", shading.bounce);
    lit.uniform("Code_", kept.code);
    lit.uniform("Shading_", shading_params(shading, input.scattering_length_mm));
    lit.uniform("Lighting_", lighting(input.lights));
    lit.uniform("Shadows_", input.shadows.lights);
    lit.sample("shadow_map",
               input.shadows.casting != 0 ? input.shadow_depth : graph.import("white", *input.head.white),
               graph::Sampler::NearestClamp);
    lit.sample("diffused_light", spreads ? input.around->light : graph.import("white", *input.head.white));
    lit.sample("skin_albedo", albedo, graph::Sampler::NearestClamp);
    lit.sample("skin_normal", normal, graph::Sampler::NearestClamp);
    lit.sample("skin_gloss", kept.gloss, graph::Sampler::NearestClamp);

    for (const SkinDraw& piece : skin.spread) {
        const shared::AtlasDraw where = atlas_draw(piece, glm::vec2(size), float(scale));
        graph::Draw& draw = spread(map, skin, piece, "skin_map", where);
        const HeadPart& part = *std::ranges::find(input.head.parts, piece.material, &HeadPart::material);
        draw.uniform("Part_", part_params(part, shading));
        bind_part(graph, draw, input.head, part, piece.wounds, input.wounds);
        spread(lit, skin, piece, "light_map", where);
    }
    std::set<std::uint32_t> shown;
    for (const SkinDraw& piece : skin.spread)
        shown.insert(piece.wounds.begin(), piece.wounds.end());
    for (const ForwardWound& wound : input.wounds)
        if (shown.contains(wound.index))
            for (const graph::ImageId image :
                 {wound.texture.color, wound.texture.state, wound.texture.relief})
                map.confine(image, kept.wounded);
    if (!shown.empty())
        map.confine("Wounds_", kept.wounded);
    for (const graph::ImageId image : {albedo, normal, kept.gloss})
        lit.in_place(image);
    if (spreads) {
        kept.wounded = scaled(input.around->wounded, scale / input.around->scale, 2, size); // 2: by a filter
        kept.reach_m = input.around->reach_m;
        lit.confine(input.around->light, input.around->wounded, kept.wounded);
    }
    return kept;
}

} // namespace

bool can_keep_light(const optics::Shading& shading, const Shadows& shadows)
{
    return shading.lambertian() && shading.drawn_transport() != optics::Transport::Published &&
           !shading.by_viewer() && !shading.in_picture() && shading.alpha_x == shading.alpha_y &&
           shading.alpha_x >= least_even_slope && (shadows.casting & ~3u) == 0;
}

SkinLight add_skin_light(graph::Graph& graph, const ForwardInput& input, const Skin& skin, double scale,
                         const optics::Shading& shading, float exposure_stops)
{
    return add_light(graph, input, skin, scale, shading,
                     shared::LightCode{brightest(input, shading, exposure_stops)});
}

SkinLight add_received_light(graph::Graph& graph, const ForwardInput& input, const Skin& skin, double scale,
                             const optics::Shading& shading)
{
    return add_light(graph, input, skin, scale, shading, std::nullopt);
}

} // namespace passes
