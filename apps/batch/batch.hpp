// `cicatrix batch`: a table of variations becomes a folder of captures. Each variation is drawn into a hidden
// folder that takes its name when it is whole, so a batch that was stopped goes on where it was, and any
// number of machines may each draw a share into the same place without knowing of one another.
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
    std::filesystem::path out = "batch"; // OUT/NAME/ holds what `capture` writes
    std::vector<std::string> views;      // as for `capture`
    bool labels = false;
};

struct BatchResult
{
    std::size_t drawn = 0, kept = 0;
    double seconds = 0;                // spent on those that were not kept
    std::vector<std::string> failures; // "NAME: what went wrong"
};

/// Draws those of `variations` that OUT does not hold yet. One that fails (a photograph in which no wound is
/// found) is told at once and does not stop the others. Throws base::InputError when OUT cannot be
/// written.
BatchResult run_batch(stage::Renderer& renderer, const std::vector<Variation>& variations,
                      const BatchOptions& options);

/// Joins what the variations' folders hold: OUT/batch.json and, with labels, OUT/coco.json and
/// OUT/measurements.csv. Throws base::InputError when variations are missing.
void merge_batch(const std::vector<Variation>& variations, const BatchOptions& options);

void add(CLI::App& program);

} // namespace batch_command
