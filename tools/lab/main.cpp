// `cicatrix-lab COMMAND ...`: makes the tables of docs/ and checks the science against published values. Not
// needed to use the program.
#include <CLI/CLI.hpp>

#include "base/program.hpp"
#include "tools/lab/commands.hpp"

int main(int argc, char** argv)
{
    CLI::App program("Makes the tables of Cicatrix' documentation, and checks its science.", "cicatrix-lab");
    lab::add_compare_models(program);
    lab::add_calibrate(program);
    lab::add_check_reflectance(program);
    lab::add_ward_albedo(program);
    lab::add_warps(program);
    lab::add_scene_fields(program);
    return base::run_program(program, argc, argv);
}
