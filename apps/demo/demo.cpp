#include "apps/demo/demo.hpp"

#include "apps/demo/demo_window.hpp"
#include "base/number_option.hpp"
#include <CLI/CLI.hpp>

namespace demo_command {

void add(CLI::App& program)
{
    auto options = std::make_shared<DemoOptions>();
    CLI::App* command =
        program.add_subcommand("demo", "Open a window: turn the head, move the light, place wounds, "
                                       "play through the days");
    scene::add_scene_options(*command, *options);
    command->add_option("--scale", options->scale, "Scale of text and controls (default: the screen's)")
        ->check(base::number_from(0.5, 4));
    command
        ->add_option("--screenshot", options->screenshot, "Save the complete window as a picture, then quit")
        ->type_name("FILE.png");
    command->add_option("--events", options->events, "Write events to FILE, one JSON object per line")
        ->type_name("FILE")
        ->group("");
    command->footer("Example: cicatrix demo scenes/chin.json\nF1 in the window lists keys and gestures.");
    command->callback([options] { DemoWindow(*options).run(); });
}

} // namespace demo_command
