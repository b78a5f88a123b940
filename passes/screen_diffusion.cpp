#include "passes/screen_diffusion.hpp"

#include <algorithm>
#include <cmath>

#include "base/last.hpp"
#include "head/vectors.hpp"
#include "passes/diffusion.hpp"
#include "passes/skin.hpp"
#include "shaders/shared/skin.h"
#include "wound/optics/separable.hpp"

namespace passes {
namespace {

/// Pixels of a length of a metre, one metre away.
double pixels_at_1m(const head::Camera& camera, std::uint32_t picture_height)
{
    return .5 * picture_height / std::tan(.5 * glm::radians(camera.fov_deg));
}

/// Widths of the profile, to the outermost sample of either transport.
double farthest_tap()
{
    const auto& taps = optics::diffusion_taps();
    return std::max(double(shared::SEPARABLE_REACH), std::hypot(taps.back()[0], taps.back()[1]));
}

/// Of a tissue; costs milliseconds, so it is kept.
const shared::SeparableKernel& kernel(const optics::TissueSpread& tissue)
{
    thread_local base::Last<optics::TissueSpread, shared::SeparableKernel> known;
    return known.of(tissue, [](const optics::TissueSpread& of) {
        shared::SeparableKernel result{};
        const auto taps = optics::separable_kernel(of.width_mm);
        for (std::size_t k = 0; k < taps.size(); ++k)
            result.taps[k] = {head::to_glm(taps[k].weight), float(taps[k].place)};
        return result;
    });
}

} // namespace

ScreenDiffusion screen_diffusion(const head::Camera& camera, const ViewportTile& tile, const Head& head,
                                 const optics::TissueSpread& tissue, optics::Transport transport)
{
    const glm::dvec3 nearest = glm::clamp(camera.eye, glm::dvec3(head.min), glm::dvec3(head.max));
    const double distance = std::max(glm::distance(camera.eye, nearest), 1e-3);
    const double width_m = // of skin that returns all light
        1e-3 * std::max({tissue.scattering_length_mm[0], tissue.scattering_length_mm[1],
                         tissue.scattering_length_mm[2]});
    const double scale = pixels_at_1m(camera, tile.picture[1]);
    const double reach =
        std::min(farthest_tap() * width_m * scale / distance + 2, double(shared::PICTURE_REACH));
    const glm::vec2 low(-float(tile.corner[0]), -float(tile.corner[1]));
    const glm::vec2 high = low + glm::vec2(tile.picture[0], tile.picture[1]);
    return {.transport = transport,
            .tile = {.low = glm::max(low, glm::vec2(0)),
                     .high = glm::min(high, glm::vec2(tile.size[0], tile.size[1])),
                     .corner = {tile.corner[0], tile.corner[1]},
                     .pixels_at_1m = float(scale),
                     .scattering = head::to_glm(1e-3 * tissue.scattering_length_mm)},
            .tissue = tissue,
            .reach = 2 * std::uint32_t(std::ceil(reach / 2))};
}

graph::ImageId add_screen_diffusion(graph::Graph& graph, const ForwardImages& drawn,
                                    const ScreenDiffusion& diffusion)
{
    const LightApart& apart = *drawn.apart;
    const graph::ImageDesc& of = graph.images[drawn.radiance.index].desc;
    const graph::ImageDesc desc{of.width, of.height, VK_FORMAT_R16G16B16A16_SFLOAT};
    graph::Region wounded = apart.wounded;
    const auto add = [&](const char* name, const char* shader, graph::ImageId received,
                         const char* result) -> std::pair<graph::ComputePass&, graph::ImageId> {
        const graph::ImageId spread = graph.image(result, desc);
        graph::ComputePass& pass = graph.compute(name, shader);
        pass.sample("received", received);
        pass.sample("reflectance", apart.reflectance, graph::Sampler::NearestClamp);
        pass.sample("distances", apart.distance, graph::Sampler::NearestClamp);
        pass.sample("specular", drawn.radiance, graph::Sampler::NearestClamp);
        pass.uniform("Tile_", diffusion.tile);
        pass.store("spread", spread);
        pass.dispatch(desc.width, desc.height);
        if (!wounded.empty()) {
            const graph::Region source = wounded;
            wounded = scaled(source, 1, diffusion.reach, {desc.width, desc.height});
            pass.confine(received, source, wounded);
            pass.confine(apart.distance, apart.wounded, wounded);
            pass.confine(apart.reflectance, apart.wounded, wounded);
            pass.confine(drawn.radiance, apart.wounded, wounded);
        }
        return {pass, spread};
    };
    if (diffusion.transport != optics::Transport::Separable) {
        const auto [pass, spread] = add("burley", "burley.comp", apart.received, "radiance");
        pass.uniform("Diffusion_", diffusion_params(diffusion.tissue.scattering_length_mm));
        return spread;
    }
    const auto [along_x, once] = add("separable x", "separable.comp", apart.received, "spread along x");
    along_x.uniform("Kernel_", kernel(diffusion.tissue));
    along_x.constant("ALONG_Y", false);
    const auto [along_y, spread] = add("separable y", "separable.comp", once, "radiance");
    along_y.uniform("Kernel_", kernel(diffusion.tissue));
    along_y.constant("ALONG_Y", true);
    return spread;
}

} // namespace passes
