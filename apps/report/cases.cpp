#include "apps/report/cases.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "base/file.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/synthetic/kind.hpp"

namespace report_command {
namespace {

/// The camera turned about its target around the vertical axis, `degrees` to the viewer's right.
head::Camera orbited(const head::Camera& camera, double degrees)
{
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::dvec3(0, 1, 0));
    return {camera.target + glm::dvec3(turn * glm::dvec4(camera.eye - camera.target, 0)), camera.target,
            camera.fov_deg};
}

constexpr double arc_deg = 40;

head::Camera turned(const stage::Stage& stage, double position)
{
    return orbited(stage.loaded().camera(), arc_deg * position);
}

/// Declares a frame as a window does.
graph::ImageId present(graph::Graph& graph, const stage::Stage& stage, double day, const head::Camera& camera,
                       bool light_stands = false, bool lights_rest = true)
{
    const auto size = stage.scene().size;
    const stage::FrameRequest request{
        .day = day,
        .tile = size,
        .camera = camera,
        .every_frame = false,
        .light_scale = light_stands ? stage.light_scale(stage.loaded().camera(), size[1]) : std::nullopt,
        .radiance = false,
        .lights_rest = lights_rest};
    const graph::ImageId picture = stage.declare(graph, request).images.picture;
    graph.present(picture);
    return picture;
}

/// Small ones of all kinds, evenly over the face.
std::vector<scene::Wound> many_wounds()
{
    constexpr int side = 8;
    const std::vector<std::string> kinds = wound::kind_names();
    std::vector<scene::Wound> wounds;
    for (int i = 0; i < side * side; ++i) {
        const double across = double(i % side) / (side - 1), up = double(i / side) / (side - 1);
        scene::Wound wound;
        wound.kind = kinds[std::size_t(i) % kinds.size()];
        wound.place = head::FacePoint{-.3 + .6 * across, -.3 + .75 * up};
        wound.width_mm = 6;
        wound.healing = scene::usual_healing(wound);
        wounds.push_back(wound);
    }
    return wounds;
}

/// The tissue with absorption multiplied by `factor`.
optics::HealingTissue tinted(optics::HealingTissue tissue, double factor)
{
    if (auto* table = std::get_if<optics::SkinLayers>(&tissue)) {
        for (optics::Layer& layer : table->layers)
            for (double& sigma_a : layer.sigma_a)
                sigma_a *= factor;
        return tissue;
    }
    auto& skin = std::get<optics::ChromophoreSkin>(tissue);
    for (optics::Chromophores* content : {&skin.epidermis, &skin.dermis, &skin.subcutis}) {
        content->blood *= factor;
        content->melanosomes *= factor;
    }
    return tissue;
}

} // namespace

const std::vector<std::string>& case_names()
{
    static const std::vector<std::string> names{"still",      "camera",     "camera-lit", "day",
                                                "day-camera", "light-drag", "light-rest", "light-keep",
                                                "tissue",     "read-back"};
    return names;
}

std::vector<stage::MeasuredCase> report_cases(stage::Stage& stage, const std::vector<std::string>& chosen)
{
    const scene::Scene& scene = stage.scene();
    const auto [first, last] = std::ranges::minmax(scene.days);
    const double span = last > first ? last - first : 10;
    constexpr double tint = 0.2;
    const optics::HealingTissue tissue = optics::healing_tissue_or_file(scene.tissue);
    const auto light_at = [=, &stage, scene = scene::Scene(scene)](graph::Graph& graph, double position,
                                                                   bool dragged, bool kept) {
        scene::Scene lit = scene;
        if (!lit.lights.empty())
            lit.lights.front().from.azimuth_deg += arc_deg * position;
        stage.update(lit, dragged);
        present(graph, stage, first, stage.loaded().camera(), kept, !dragged);
    };
    const auto restore = [&stage, scene = scene::Scene(scene)] { stage.update(scene); };
    std::vector<stage::MeasuredCase> cases{
        {"still", "nothing changes",
         [=, &stage](graph::Graph& graph, double) {
             present(graph, stage, first, stage.loaded().camera(), true);
         }},
        {"camera",
         fmt::format("the camera goes {:g} degrees around the head; light is kept on the skin", arc_deg),
         [=, &stage](graph::Graph& graph, double position) {
             present(graph, stage, first, turned(stage, position), true);
         }},
        {"camera-lit", "the same; light is computed in every pixel",
         [=, &stage](graph::Graph& graph, double position) {
             present(graph, stage, first, turned(stage, position));
         }},
        {"day", fmt::format("the day goes from {:g} to {:g}; the camera stands", first, first + span),
         [=, &stage](graph::Graph& graph, double position) {
             present(graph, stage, first + span * position, stage.loaded().camera());
         }},
        {"day-camera", "the day goes on while the camera turns",
         [=, &stage](graph::Graph& graph, double position) {
             present(graph, stage, first + span * position, turned(stage, position));
         }},
        {"light-drag", fmt::format("the first light goes {:g} degrees around the head", arc_deg),
         [=](graph::Graph& graph, double position) { light_at(graph, position, true, false); }, restore},
        {"light-rest", "the same, and in every frame light spreads through the skin anew",
         [=](graph::Graph& graph, double position) { light_at(graph, position, false, false); }, restore},
        {"light-keep", "the same, and each time light is kept on the skin anew",
         [=](graph::Graph& graph, double position) { light_at(graph, position, false, true); }, restore},
        // Not on the first day: then a wound has the photograph's colours, whatever the tissue.
        {"tissue",
         fmt::format("the tissue's absorption grows by {:g} %, on day {:g}", 100 * tint, first + span / 3),
         [=, &stage](graph::Graph& graph, double position) {
             stage.set_tissue(tinted(tissue, 1 + tint * position));
             present(graph, stage, first + span / 3, stage.loaded().camera());
         },
         [=, &stage] { stage.set_tissue(tissue); }},
        {"read-back", "nothing changes; the picture is copied to the host",
         [=, &stage](graph::Graph& graph, double) {
             graph.readback("picture", present(graph, stage, first, stage.loaded().camera(), true));
         }}};
    if (!chosen.empty())
        std::erase_if(cases, [&](const stage::MeasuredCase& one) {
            return std::ranges::find(chosen, one.name) == chosen.end();
        });
    return cases;
}

const std::vector<std::string>& wound_case_names()
{
    static const std::vector<std::string> names{"one-wound", "many-wounds"};
    return names;
}

std::vector<stage::MeasuredCase> wound_cases(const gpu::Device& device, const scene::Scene& scene,
                                             const std::vector<std::string>& chosen)
{
    std::vector<stage::MeasuredCase> cases;
    const double day = std::ranges::min(scene.days);
    for (const std::string& name : wound_case_names()) {
        if (std::ranges::find(chosen, name) == chosen.end())
            continue;
        scene::Scene wounded = scene;
        wounded.wounds = name == "one-wound" ? std::vector{scene::Wound{}} : many_wounds();
        const auto stage = std::make_shared<const stage::Stage>(device, stage::Stage::prepare(wounded));
        cases.push_back({name,
                         fmt::format("the case camera with {} wounds of {:g} mm", wounded.wounds.size(),
                                     wounded.wounds.front().width_mm),
                         [stage, day](graph::Graph& graph, double position) {
                             present(graph, *stage, day, turned(*stage, position), true);
                         }});
    }
    return cases;
}

std::size_t triangles_drawn(const graph::Graph& graph)
{
    std::size_t indices = 0;
    for (const graph::Pass& pass : graph.passes)
        if (const auto* raster = std::get_if<graph::RasterPass>(&pass); raster && raster->name == "forward")
            for (const graph::Draw& draw : raster->draws)
                indices += draw.index_count;
    return indices / 3;
}

} // namespace report_command
