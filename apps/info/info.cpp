#include "apps/info/info.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/gpu/device.hpp"

namespace info_command {

void add(CLI::App& program)
{
    CLI::App* command =
        program.add_subcommand("info", "List Vulkan devices, their features and what they lack");
    command->footer("Example: cicatrix info\nChoose one with --device NAME|INDEX, or with the environment "
                    "variable CICATRIX_DEVICE.");
    command->callback([] { fmt::print("{}", gpu::describe_devices()); });
}

} // namespace info_command
