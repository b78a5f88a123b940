#include "apps/demo/demo.hpp"

#include "apps/demo/demo_window.hpp"
#include "base/number_option.hpp"
#include <CLI/CLI.hpp>

namespace demo_command {

void add(CLI::App& program)
{
    auto options = std::make_shared<DemoOptions>();
    CLI::App* command =
        program.add_subcommand("demo", "A window: turn the head, move the light, place wounds, "
                                       "let the days go by");
    scene::add_scene_options(*command, *options);
    command->add_option("--scale", options->scale, "Size of text and controls; without it, the screen's")
        ->check(base::number_from(0.5, 4));
    command
        ->add_option("--screenshot", options->screenshot,
                     "Save what the window shows once it is complete, and end")
        ->type_name("FILE.png");
    command->add_option("--events", options->events, "Tell what happens, one JSON object a line")
        ->type_name("FILE")
        ->group("");
    command->footer("Example: cicatrix demo scenes/chin.json\nF1 in the window lists keys and gestures.");
    command->callback([options] { DemoWindow(*options).run(); });
}

} // namespace demo_command
