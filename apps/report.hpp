// `cicatrix report`: what every pass costs while nothing, the camera, the day or the tissue moves; as a
// table, report.json, trace.json and a page; compared with an earlier report; and how the cost grows.
#pragma once
#include <CLI/CLI.hpp>

namespace app {

void add_report_command(CLI::App& program);

} // namespace app
