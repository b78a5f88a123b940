#include "apps/info.hpp"

#include <fmt/format.h>

#include "engine/device.hpp"

namespace app {

void add_info_command(CLI::App& program)
{
    CLI::App* command =
        program.add_subcommand("info", "List Vulkan devices, what they offer and what they lack");
    command->footer("Example: cicatrix info\nChoose one with --device NAME|INDEX, or with the environment "
                    "variable CICATRIX_DEVICE.");
    command->callback([] { fmt::print("{}", engine::describe_devices()); });
}

} // namespace app
