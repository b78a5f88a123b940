// `cicatrix report`: what every pass costs while nothing, the camera, the day or the tissue moves; as a
// table, report.json, trace.json and a page; compared with an earlier report; and how the cost grows.
#pragma once

namespace CLI {
class App;
}

namespace report_command {

void add(CLI::App& program);

} // namespace report_command
