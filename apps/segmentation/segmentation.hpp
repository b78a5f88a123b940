// `cicatrix segmentation PHOTO MASK`: compares the segmentation of a photograph with a mask drawn by hand.
#pragma once

namespace CLI {
class App;
}

namespace segmentation_command {

void add(CLI::App& program);

} // namespace segmentation_command
