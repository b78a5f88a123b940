// `cicatrix batch`: draws a table of variations, one capture folder each. A variation is drawn into a hidden
// folder that is renamed when it is complete. So a stopped batch can be resumed, and several machines can
// each draw a share into the same folder without communicating.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "apps/batch/variations.hpp"
#include "stage/renderer.hpp"

namespace CLI {
class App;
}

namespace batch_command {

struct BatchOptions
{
    std::filesystem::path out = "batch"; // OUT/NAME/ holds the files that `capture` writes
    std::vector<std::string> views;      // as for `capture`
    bool labels = false;
};

struct BatchResult
{
    std::size_t drawn = 0, kept = 0;
    double seconds = 0;                // wall clock of all variations drawn now, without the kept ones
    std::vector<std::string> failures; // "NAME: what went wrong"
};

/// Draws those `variations` that OUT does not contain yet. When one fails (for example, no wound is found in
/// its photograph), the error is printed at once and the others continue. Throws base::InputError when OUT
/// cannot be written, or when another batch is drawing one of them there.
BatchResult run_batch(stage::Renderer& renderer, const std::vector<Variation>& variations,
                      const BatchOptions& options);

/// Joins the results of all variations: writes OUT/batch.json and, with labels, OUT/coco.json and
/// OUT/measurements.csv. Throws base::InputError when variations are missing.
void merge_batch(const std::vector<Variation>& variations, const BatchOptions& options);

void add(CLI::App& program);

} // namespace batch_command
