#include "passes/chang.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/last.hpp"
#include "head/vectors.hpp"
#include "passes/skin_light.hpp"
#include "wound/optics/dipole.hpp"

namespace passes {
namespace {

constexpr double refractive_index = 1.4; // of skin, for the dipole's boundary
constexpr double local_light = .99; // share of the widest channel's light that is gathered in the picture

std::array<optics::Dipole, 3> dipoles(const optics::TissueSpread& tissue)
{
    static const optics::DipoleInversion inversion(refractive_index);
    const auto of = [&](int c) {
        const double length = std::max(tissue.scattering_length_mm[c], 1e-3);
        return inversion.dipole_of(tissue.width_mm[c] / length, length);
    };
    return {of(0), of(1), of(2)};
}

/// What of the view the tissue decides; costs milliseconds.
shared::ChangView view_of_tissue(const optics::TissueSpread& tissue)
{
    shared::ChangView view{};
    const std::array<optics::Dipole, 3> dipole = dipoles(tissue);
    double local = 0;
    for (const optics::Dipole& channel : dipole) {
        double radius = 0;
        while (channel.within(radius) < local_light * channel.total())
            radius += .01;
        local = std::max(local, radius);
    }
    view.local_mm = float(local);
    for (int c = 0; c < 3; ++c) {
        const optics::DipoleSources& sources = dipole[std::size_t(c)].sources;
        view.dipole.transport[c] = float(sources.transport);
        view.dipole.depth[c] = float(sources.depth);
        view.dipole.image[c] = float(sources.image);
        view.dipole.per_total[c] = float(1 / sources.total());
        view.local_share[c] = float(sources.within(local) / sources.total());
    }
    const auto& taps = optics::diffusion_taps();
    const double reach = std::hypot(taps.back()[0], taps.back()[1]);
    for (std::size_t k = 0; k < taps.size(); ++k)
        view.taps[k] = {taps[k][0] / reach, taps[k][1] / reach, taps[k][2], 0};
    return view;
}

/// Where the skin is at home on an atlas of this size.
graph::ImageId add_home(graph::Graph& graph, const Skin& skin, const glm::uvec2& size, double scale)
{
    const graph::ImageId home = graph.image("skin home", {size.x, size.y, VK_FORMAT_R32G32B32A32_SFLOAT});
    graph::RasterPass& pass = graph.raster("skin home");
    pass.color(home, {0, 0, 0, 0});
    for (const SkinDraw& piece : skin.lit) {
        graph::Draw& draw = pass.draw("chang_home");
        draw.mesh = skin.mesh.get();
        draw.first_index = piece.first_index;
        draw.index_count = piece.index_count;
        draw.cull_back_faces = false; // charts may be mirrored
        draw.uniform("Draw_", shared::AtlasDraw{.skirt = glm::vec2(0),
                                                .low = float(scale) * glm::vec2(piece.corner),
                                                .high = float(scale) * glm::vec2(piece.corner + piece.size)});
    }
    return home;
}

} // namespace

SkinSamples add_skin_samples(graph::Graph& graph, const ForwardInput& input, const Skin& skin, double scale,
                             const optics::Shading& shading)
{
    const SkinLight received = add_received_light(graph, input, skin, scale, shading);
    glm::uvec2 size(glm::dvec2(skin.size) * scale);
    const graph::ImageId home = add_home(graph, skin, size, scale);
    std::vector<graph::ImageId> levels;
    const auto bind = [&](graph::ComputePass& pass) {
        pass.sample("home", home, graph::Sampler::NearestClamp);
        pass.sample("irradiance", received.light, graph::Sampler::NearestClamp);
    };
    for (int k = 0; k < shared::CHANG_LEVELS; ++k) {
        size = (size + 3u) / 4u;
        const std::string name = fmt::format("importance {}", k + 1);
        const graph::ImageId level = graph.image(name, {size.x, size.y, VK_FORMAT_R32_SFLOAT});
        graph::ComputePass& pass = graph.compute(name, "chang_importance.comp");
        bind(pass);
        pass.sample("finer", k == 0 ? home : levels.back(), graph::Sampler::NearestClamp);
        pass.constant("FIRST", k == 0);
        pass.store("level", level);
        pass.dispatch(size.x, size.y);
        levels.push_back(level);
    }
    const graph::ImageDesc list{std::uint32_t(shared::CHANG_SAMPLES), 1, VK_FORMAT_R32G32B32A32_SFLOAT};
    const SkinSamples samples{graph.image("sample places", list), graph.image("sample lights", list)};
    graph::ComputePass& pass = graph.compute("skin samples", "chang_samples.comp");
    bind(pass);
    pass.sample("levels", levels, graph::Sampler::NearestClamp);
    pass.store("sample_places", samples.places);
    pass.store("sample_lights", samples.lights);
    pass.dispatch(list.width, 1);
    return samples;
}

shared::ChangView chang_view(const head::Camera& camera, const ViewportTile& tile,
                             const optics::TissueSpread& tissue)
{
    thread_local base::Last<optics::TissueSpread, shared::ChangView> known;
    shared::ChangView view = known.of(tissue, view_of_tissue);
    const glm::dmat3 rows = glm::transpose(glm::dmat3(head::view_from_world(camera)));
    view.eye = 1e3 * camera.eye;
    view.right = rows[0];
    view.down = -rows[1];
    view.forward = -rows[2];
    view.centre = glm::vec2(.5 * tile.picture[0] - tile.corner[0], .5 * tile.picture[1] - tile.corner[1]);
    return view;
}

graph::ImageId add_chang(graph::Graph& graph, const ForwardImages& drawn, const ScreenDiffusion& diffusion,
                         const SkinSamples& samples, const shared::ChangView& view)
{
    const LightApart& apart = *drawn.apart;
    const graph::ImageDesc& of = graph.images[drawn.radiance.index].desc;
    const graph::ImageId spread =
        graph.image("radiance", {of.width, of.height, VK_FORMAT_R16G16B16A16_SFLOAT});
    graph::ComputePass& pass = graph.compute("chang", "chang.comp");
    pass.sample("received", apart.received);
    pass.sample("reflectance", apart.reflectance, graph::Sampler::NearestClamp);
    pass.sample("distances", apart.distance, graph::Sampler::NearestClamp);
    pass.sample("specular", drawn.radiance, graph::Sampler::NearestClamp);
    pass.sample("sample_places", samples.places, graph::Sampler::NearestClamp);
    pass.sample("sample_lights", samples.lights, graph::Sampler::NearestClamp);
    pass.uniform("Tile_", diffusion.tile);
    pass.uniform("Chang_", view);
    pass.store("spread", spread);
    pass.dispatch(of.width, of.height);
    return spread;
}

} // namespace passes
