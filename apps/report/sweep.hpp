// How the cost grows: the same frame with one quantity in steps, everything else fixed, and the power law
// that fits.
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

/// What one thing costs at every step.
struct SweepSeries
{
    std::string name;                  // a pass (of all wounds together), "frame", or work of the CPU
    std::vector<double> x;             // of the steps at which it was done
    std::vector<base::Spread> ms;      // the same
    std::optional<base::PowerLaw> law; // through the medians; none with fewer than three steps
};

struct Sweep
{
    std::string kind, x_label;
    std::string fixed; // what stayed the same, and what a step is
    std::vector<SweepSeries> series;
};

/// Measures one kind. Throws base::InputError when the scene has no wound and the kind needs one.
Sweep measure_sweep(const std::string& kind, const scene::Scene& scene, const gpu::Device& device,
                    const graph::ShaderLibrary& library, const stage::Rounds& rounds,
                    const std::function<void(int)>& progress);

std::string to_text(const Sweep& sweep);
nlohmann::json to_json(const Sweep& sweep);
/// Both axes logarithmic.
base::Chart sweep_chart(const Sweep& sweep, const gpu::DeviceInfo& device);

} // namespace report_command
