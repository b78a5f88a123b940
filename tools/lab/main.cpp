// `cicatrix-lab COMMAND ...`: makes the tables of docs/ and checks the models against published values.
// Users of cicatrix do not need it.
#include <CLI/CLI.hpp>

#include "base/program.hpp"
#include "tools/lab/commands.hpp"

int main(int argc, char** argv)
{
    CLI::App program("Makes the tables of Cicatrix' documentation and checks its models.", "cicatrix-lab");
    lab::add_compare_models(program);
    lab::add_calibrate(program);
    lab::add_check_reflectance(program);
    lab::add_ward_albedo(program);
    lab::add_warps(program);
    lab::add_scene_fields(program);
    lab::add_terms(program);
    lab::add_truth(program);
    return base::run_program(program, argc, argv);
}
