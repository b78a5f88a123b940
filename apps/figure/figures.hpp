// The paper's figures: what each shows there and here, and the function that draws it.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace figure_command {

class Workbench;

struct Figure
{
    const char* name; // on the command line: "1" .. "9", "frame-rate"
    const char* title;
    const char* paper; // one sentence: what the paper's figure shows
    const char* ours;  // one sentence: what ours shows, and where it differs
    void (*draw)(Workbench&);

    /// Of its files: "figure_1", "frame_rate".
    std::string stem() const;
    /// "Figure 1", "Frame rate".
    std::string heading() const;
};

/// In the order of the paper.
std::span<const Figure> all_figures();

void draw_control_points(Workbench& bench);   // Figure 1
void draw_phase_function(Workbench& bench);   // Figure 2
void draw_layers(Workbench& bench);           // Figure 3
void draw_contraction(Workbench& bench);      // Figure 4
void draw_depth(Workbench& bench);            // Figure 5
void draw_recovery(Workbench& bench);         // Figure 6
void draw_shading(Workbench& bench);          // Figure 7
void draw_recovery_on_face(Workbench& bench); // Figure 8
void draw_chin(Workbench& bench);             // Figure 9
void draw_frame_rate(Workbench& bench);       // section 6.4

} // namespace figure_command
