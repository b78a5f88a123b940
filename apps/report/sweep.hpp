// Sweeps: measures a frame while one quantity grows and everything else is fixed, and fits a power law.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/chart.hpp"
#include "base/statistics.hpp"
#include "scene/scene.hpp"
#include "stage/measurement.hpp"

namespace report_command {

/// "size", "triangles", "wounds", "points", "lut".
std::vector<std::string> sweep_names();

/// The cost of a pass or another part of a frame at every step.
struct SweepSeries
{
    std::string name;                  // a pass (summed over all wounds), "frame", or CPU work
    std::vector<double> x;             // of the steps at which it ran
    std::vector<base::Spread> ms;      // at each x
    std::optional<base::PowerLaw> law; // fitted to the medians; none with fewer than three steps
};

struct Sweep
{
    std::string kind, x_label;
    std::string fixed; // describes what is fixed and what a step is
    std::vector<SweepSeries> series;
};

/// `kind`: one of sweep_names(). Throws base::InputError when `kind` needs a wound and the scene has none.
Sweep measure_sweep(const std::string& kind, const scene::Scene& scene, const gpu::Device& device,
                    const graph::ShaderLibrary& library, const stage::Rounds& rounds,
                    const std::function<void(int)>& progress);

std::string to_text(const Sweep& sweep);
nlohmann::json to_json(const Sweep& sweep);
/// Time against x, both axes logarithmic; `device` is the footnote.
base::Chart sweep_chart(const Sweep& sweep, const std::string& device);

} // namespace report_command
