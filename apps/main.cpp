// The program `cicatrix COMMAND ...`: registers all commands.
#include <CLI/CLI.hpp>

#include "apps/bake/bake.hpp"
#include "apps/batch/batch.hpp"
#include "apps/capture/capture.hpp"
#include "apps/compare/compare.hpp"
#include "apps/demo/demo.hpp"
#include "apps/document/document.hpp"
#include "apps/figure/figure.hpp"
#include "apps/fit/fit.hpp"
#include "apps/graph/graph.hpp"
#include "apps/info/info.hpp"
#include "apps/predict/predict.hpp"
#include "apps/reference/reference.hpp"
#include "apps/reflect/reflect.hpp"
#include "apps/report/report.hpp"
#include "apps/segmentation/segmentation.hpp"
#include "apps/wound/wound.hpp"
#include "base/program.hpp"

int main(int argc, char** argv)
{
    CLI::App program("Cicatrix shows how a wound on a face heals, day by day, from a photograph.",
                     "cicatrix");
    program.footer("Example: cicatrix capture --days 0:30:3 --out healing\nHelp for a command: "
                   "cicatrix capture --help");
    demo_command::add(program);
    capture_command::add(program);
    report_command::add(program);
    batch_command::add(program);
    compare_command::add(program);
    graph_command::add(program);
    info_command::add(program);
    wound_command::add(program);
    fit_command::add(program);
    segmentation_command::add(program);
    predict_command::add(program);
    reflect_command::add(program);
    reference_command::add(program);
    bake_command::add(program);
    figure_command::add(program);
    document_command::add(program);
    return base::run_program(program, argc, argv);
}
