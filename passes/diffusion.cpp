#include "passes/diffusion.hpp"

#include <algorithm>
#include <cmath>

#include "head/vectors.hpp"
#include "wound/optics/transport.hpp"

namespace passes {
namespace {

constexpr double narrow_texels = 2; // of a skirt, for filters
constexpr double wide_texels = 16;  // for light that spreads: as far as the taps go where a texel is as wide

/// Draws the skin's surface: first the wide skirts, then the narrow ones, which filters at the border of
/// their chart need, then the skin. All of one kind before the next, as charts of other tiles may be near.
void draw_surface(graph::RasterPass& pass, std::string_view shader, const Skin& skin, double scale)
{
    for (const int layer : {0, 1, 2})
        for (const head::SurfacePiece& piece : skin.surface) {
            const std::uint32_t count = layer == 2 ? piece.triangles : piece.skirts;
            if (count == 0)
                continue;
            graph::Draw& draw = pass.draw(shader);
            draw.mesh = skin.surface_mesh.get();
            draw.first_index = piece.first_index + (layer == 2 ? piece.skirts : 0);
            draw.index_count = count;
            draw.cull_back_faces = false; // charts may be mirrored
            const double width = (layer == 0 ? wide_texels : narrow_texels) / scale;
            draw.uniform("Surface_",
                         shared::SurfaceDraw{.size = glm::vec2(skin.size),
                                             .skirt = layer == 2 ? 0 : float(width),
                                             .low = float(scale) * glm::vec2(piece.corner),
                                             .high = float(scale) * glm::vec2(piece.corner + piece.size)});
        }
}

} // namespace

shared::Diffusion diffusion_params(const base::Color& scattering_mm)
{
    shared::Diffusion params{.scattering_mm = head::to_glm(scattering_mm)};
    const auto& taps = optics::diffusion_taps();
    for (std::size_t k = 0; k < taps.size(); ++k)
        params.taps[k] = {head::to_glm(taps[k]), 0};
    return params;
}

DiffusedLight add_diffusion(graph::Graph& graph, const ForwardInput& input, const Skin& skin, double scale,
                            const optics::Shading& shading)
{
    const SkinLight received = add_received_light(graph, input, skin, scale, shading);
    const glm::uvec2 size(glm::dvec2(skin.size) * scale);
    const shared::Diffusion params = diffusion_params(shading.rho_d * input.scattering_length_mm);
    const double widest_mm =
        std::max({params.scattering_mm.x, params.scattering_mm.y, params.scattering_mm.z});
    DiffusedLight around{
        .light = graph.image("skin diffused", {size.x, size.y, VK_FORMAT_R16G16B16A16_SFLOAT}),
        .scale = scale,
        .reach_m = 1e-3 * widest_mm * glm::length(glm::vec2(params.taps[shared::DIFFUSION_TAPS - 1]))};

    const graph::ImageId places = graph.image("skin places", {size.x, size.y, VK_FORMAT_R32G32B32A32_SFLOAT}),
                         metrics =
                             graph.image("skin metrics", {size.x, size.y, VK_FORMAT_R16G16B16A16_SFLOAT}),
                         gathered =
                             graph.image("skin gathered", {size.x, size.y, VK_FORMAT_R16G16B16A16_SFLOAT});
    graph::RasterPass& place = graph.raster("skin places");
    place.color(places, {0, 0, 0, 0});
    place.color(metrics, {1, 0, 1, 1});
    draw_surface(place, "skin_places", skin, scale);

    graph::RasterPass& gather = graph.raster("skin gathered");
    gather.color(gathered, {0, 0, 0, 0});
    gather.sample("irradiance", received.light); // filtered: a skirt's places are between texels
    draw_surface(gather, "skin_gathered", skin, scale);
    const graph::Region near = scaled(received.wounded, 1, 1, size); // by a filter
    gather.confine(received.light, received.wounded, near);

    graph::ComputePass& spread = graph.compute("skin diffused", "skin_diffused.comp");
    spread.sample("places", places, graph::Sampler::NearestClamp);
    spread.sample("metrics", metrics, graph::Sampler::NearestClamp);
    spread.sample("gathered", gathered, graph::Sampler::NearestClamp);
    spread.sample("skin_albedo", received.albedo);
    spread.store("diffused", around.light);
    spread.uniform("Diffusion_", params);
    spread.dispatch(size.x, size.y);
    around.wounded = scaled(near, 1, shared::DIFFUSION_REACH, size);
    spread.confine(gathered, near, around.wounded);
    spread.confine(received.albedo, received.wounded, near);
    return around;
}

} // namespace passes
