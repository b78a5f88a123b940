#include "apps/graph/graph.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>

#include "base/file.hpp"
#include "engine/gpu/executor.hpp"
#include "engine/graph/plan_text.hpp"
#include "scene/command_line.hpp"
#include "stage/renderer.hpp"

namespace graph_command {
namespace {

struct GraphOptions : scene::SceneOptions
{
    std::filesystem::path dot;
};

void print_schedules(const GraphOptions& options)
{
    scene::Scene scene = scene::chosen_scene(options);
    gpu::Device device(stage::device_options(options));
    graph::ShaderLibrary library;
    gpu::Executor executor(device, library);
    const stage::Stage stage(device, stage::Stage::prepare(scene));
    std::string dot;
    for (const double day : scene.days) {
        graph::Graph graph;
        graph.readback("picture",
                       stage.declare(graph, {.day = day, .tile = stage.scene().size, .every_frame = false}).images.picture);
        const gpu::FrameResult frame = executor.run(graph);
        fmt::print("day {:g}\n{}\n", day, graph::plan_text(graph, frame.plan));
        dot = graph::plan_dot(graph, frame.plan);
    }
    if (!options.dot.empty())
        base::write_text(options.dot, dot);
}

} // namespace

void add(CLI::App& program)
{
    auto options = std::make_shared<GraphOptions>();
    CLI::App* command =
        program.add_subcommand("graph", "Print the schedule of a scene's frames: passes, images, barriers, "
                                        "skipped and culled passes with reasons");
    scene::add_scene_options(*command, *options);
    command->add_option("--dot", options->dot, "Write the last frame's schedule in Graphviz format")
        ->type_name("FILE.dot");
    command->footer(
        "Example: cicatrix graph --days 0,0,3 --dot frame.dot && dot -Tsvg frame.dot -o frame.svg");
    command->callback([options] { print_schedules(*options); });
}

} // namespace graph_command
