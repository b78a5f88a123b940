// `cicatrix segmentation PHOTO MASK`: a wound found in a photograph against one drawn by hand.
#pragma once

namespace CLI {
class App;
}

namespace segmentation_command {

void add(CLI::App& program);

} // namespace segmentation_command
