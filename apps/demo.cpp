#include "apps/demo.hpp"

#include "apps/demo_window.hpp"
#include "apps/number_option.hpp"

namespace app {

void add_demo_command(CLI::App& program)
{
    auto options = std::make_shared<DemoOptions>();
    CLI::App* command =
        program.add_subcommand("demo", "A window: turn the head, move the light, place wounds, "
                                       "let the days go by");
    add_scene_options(*command, *options);
    command->add_option("--scale", options->scale, "Size of text and controls; without it, the screen's")
        ->check(number_from(0.5, 4));
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

} // namespace app
