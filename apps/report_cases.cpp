#include "apps/report_cases.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "apps/bake.hpp"

namespace app {
namespace {

/// The camera on its way around the head, `degrees` further to the viewer's right.
passes::Camera orbited(const passes::Camera& camera, double degrees)
{
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::dvec3(0, 1, 0));
    return {camera.target + glm::dvec3(turn * glm::dvec4(camera.eye - camera.target, 0)), camera.target,
            camera.fov_deg};
}

/// Tissue that absorbs `factor` times as much.
wound::HealingTissue tinted(wound::HealingTissue tissue, double factor)
{
    if (auto* table = std::get_if<wound::SkinLayers>(&tissue)) {
        for (wound::Layer& layer : table->layers)
            for (double& sigma_a : layer.sigma_a)
                sigma_a *= factor;
        return tissue;
    }
    auto& skin = std::get<wound::ChromophoreSkin>(tissue);
    for (wound::Chromophores* content : {&skin.epidermis, &skin.dermis, &skin.subcutis}) {
        content->blood *= factor;
        content->melanosomes *= factor;
    }
    return tissue;
}

} // namespace

std::vector<MeasuredCase> report_cases(Stage& stage)
{
    const Scene& scene = stage.scene();
    const auto [first, last] = std::ranges::minmax(scene.days);
    const double span = last > first ? last - first : 10;
    constexpr double arc_deg = 40, tint = 0.2;
    const auto declare = [&stage](engine::Graph& graph, double day, const passes::Camera& camera) {
        const Scene& now = stage.scene();
        graph.readback("picture",
                       stage.declare(graph, stage.wounds_on(day), camera, now.shading, now.size).picture);
    };
    const wound::HealingTissue tissue = healing_tissue_or_file(scene.tissue);
    return {
        {"still frame", "nothing changes",
         [=, &stage](engine::Graph& graph, double) { declare(graph, first, stage.camera()); }},
        {"moving camera", fmt::format("the camera goes {:g} degrees around the head", arc_deg),
         [=, &stage](engine::Graph& graph, double position) {
             declare(graph, first, orbited(stage.camera(), arc_deg * position));
         }},
        {"moving day", fmt::format("the day goes from {:g} to {:g}", first, first + span),
         [=, &stage](engine::Graph& graph, double position) {
             declare(graph, first + span * position, stage.camera());
         }},
        // On the first day a wound still has the photograph's colours, whatever the tissue.
        {"moving tissue",
         fmt::format("the tissue's absorption grows by {:g} %, on day {:g}", 100 * tint, first + span / 3),
         [=, &stage](engine::Graph& graph, double position) {
             stage.set_tissue(tinted(tissue, 1 + tint * position));
             declare(graph, first + span / 3, stage.camera());
         },
         [=, &stage] { stage.set_tissue(tissue); }}};
}

std::size_t triangles_drawn(const engine::Graph& graph)
{
    std::size_t indices = 0;
    for (const engine::Pass& pass : graph.passes)
        if (const auto* raster = std::get_if<engine::RasterPass>(&pass); raster && raster->name == "forward")
            for (const engine::Draw& draw : raster->draws)
                indices += draw.index_count;
    return indices / 3;
}

} // namespace app
