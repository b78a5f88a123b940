#include "apps/graph_command.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>

#include "apps/scene_options.hpp"
#include "apps/stage.hpp"
#include "engine/executor.hpp"
#include "engine/image_io.hpp"
#include "engine/plan_text.hpp"

namespace app {
namespace {

struct GraphOptions : SceneOptions
{
    std::filesystem::path dot;
};

void print_schedules(const GraphOptions& options)
{
    Scene scene = chosen_scene(options);
    engine::Device device(device_options(options));
    engine::ShaderLibrary library;
    engine::Executor executor(device, library);
    const Stage stage(device, scene, Stage::prepare(scene));
    std::string dot;
    for (const double day : scene.days) {
        engine::Graph graph;
        graph.readback(
            "picture",
            stage.declare(graph, stage.wounds_on(day), stage.camera(), scene.shading, scene.size).picture);
        const engine::FrameResult frame = executor.run(graph);
        fmt::print("day {:g}\n{}\n", day, engine::plan_text(graph, frame.plan));
        dot = engine::plan_dot(graph, frame.plan);
    }
    if (!options.dot.empty())
        engine::write_atomically(options.dot,
                                 [&](const std::filesystem::path& path) { std::ofstream(path) << dot; });
}

} // namespace

void add_graph_command(CLI::App& program)
{
    auto options = std::make_shared<GraphOptions>();
    CLI::App* command =
        program.add_subcommand("graph", "Print the schedule of a scene's frames: passes, images, barriers, "
                                        "what was skipped or culled and why");
    add_scene_options(*command, *options);
    command->add_option("--dot", options->dot, "Write the last frame's schedule as Graphviz")
        ->type_name("FILE.dot");
    command->footer(
        "Example: cicatrix graph --days 0,0,3 --dot frame.dot && dot -Tsvg frame.dot -o frame.svg");
    command->callback([options] { print_schedules(*options); });
}

} // namespace app
