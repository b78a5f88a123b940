// `cicatrix report`: measures the cost of every pass while nothing, the camera, the day or the tissue
// changes; writes a table, report.json, trace.json and a page; compares with an earlier report; measures
// sweeps.
#pragma once

namespace CLI {
class App;
}

namespace report_command {

void add(CLI::App& program);

} // namespace report_command
